#include "core/meshes/vtk/vtk_legacy_types.h"

#include <fmt/format.h>

#include <string>

#include "core/meshes/text/letter_case.h"

namespace dartboard {

std::optional<Scalar> vtk_legacy_type(std::string_view given) {
  const std::string name = lower(given);
  if (name == "char" || name == "signed_char" || name == "vtktypeint8") return Scalar::int8;
  if (name == "unsigned_char" || name == "vtktypeuint8") return Scalar::uint8;
  if (name == "short" || name == "vtktypeint16") return Scalar::int16;
  if (name == "unsigned_short" || name == "vtktypeuint16") return Scalar::uint16;
  // VTK writes its numbers of points and cells as int
  if (name == "int" || name == "vtktypeint32" || name == "vtkidtype") return Scalar::int32;
  if (name == "unsigned_int" || name == "vtktypeuint32") return Scalar::uint32;
  if (name == "long" || name == "vtktypeint64") return Scalar::int64;
  if (name == "unsigned_long" || name == "vtktypeuint64") return Scalar::uint64;
  if (name == "float") return Scalar::float32;
  if (name == "double") return Scalar::float64;
  return std::nullopt;
}

Scalar read_vtk_legacy_type(TextScanner& scan, Wanted wanted) {
  const std::string_view name = scan.token(wanted);
  const auto type = vtk_legacy_type(name);
  if (!type)
    scan.fail(fmt::format("the type {}", in_quotes(name)), "float, double, int, long, vtktypeint64 or the like");
  return *type;
}

}  // namespace dartboard
