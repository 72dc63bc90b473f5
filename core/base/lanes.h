#pragma once
// Whether loops take four numbers at a time where the processor has AVX2. They leave the bits of one at a time.

namespace dartboard {

/// Do they? Not without AVX2, nor after `use_lanes(false)`.
bool lanes_are_on();

/// Turn lanes off, or on again where the processor has them: for comparisons. Not while another thread steps.
///
/// returns  whether they were on
bool use_lanes(bool on);

}  // namespace dartboard
