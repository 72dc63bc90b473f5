#pragma once
// The types of numbers in legacy VTK files, by their names.

#include <optional>
#include <string_view>

#include "core/meshes/bytes/scalar.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {

/// The type of a name, in capitals or small letters; no value for types other than numbers of whole bytes: bits,
/// strings, variants.
std::optional<Scalar> vtk_legacy_type(std::string_view name);

/// The type that is named next.
Scalar read_vtk_legacy_type(TextScanner& scan, Wanted wanted);

}  // namespace dartboard
