#pragma once
// A body in figures that a person can compare with what was intended.

#include <cstdint>
#include <string>
#include <string_view>

#include "core/scene/body/simulated_body.h"

namespace dartboard {

/// "6 m along x, 1 m along y, 1 m along z; 36.6 tonnes; edges of 0.5 to 0.87 m; springs of 64 to 384 N/m", as it is
/// now.
std::string in_words(const SimulatedBody& body);

/// "3-g-map"; "no map is needed" where nothing changes the topology.
std::string map_in_words(std::string_view map_name);

/// "vertex 12", by its number in the file of the mesh; "a vertex that refinement made" for no_point.
std::string vertex_in_words(std::uint32_t number);

/// "36.6 tonnes", "2.5 kg", "40 g"
std::string mass_in_words(double kg);

}  // namespace dartboard
