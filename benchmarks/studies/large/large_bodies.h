#pragma once
// What `bench large` measures in a process of its own: a run of a large body, part by part, with a cut on the way.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace dartboard {

/// Parts of a run, in its order.
namespace large_part {
inline constexpr const char* mesh = "mesh generated";
inline constexpr const char* map = "map built";
inline constexpr const char* columns = "body without a map made";
inline constexpr const char* simulation = "simulation made, mesh and map included";
inline constexpr const char* first_step = "from the start to the first step";
inline constexpr const char* step = "a step";
inline constexpr const char* cut = "the cut, without the step";
inline constexpr const char* step_after = "a step after the cut";
inline constexpr const char* diagnostics = "diagnostics";
inline constexpr const char* frame = "frame made";
inline constexpr const char* written = "frame written";
inline constexpr const char* compressed = "frame written, compressed by lz4";
inline constexpr const char* read = "frame read";
inline constexpr const char* info = "mesh info of the frame";
}  // namespace large_part
std::span<const char* const> large_parts();

/// The parts of a run that has `side` cubes of six tetrahedra along each edge of a box, which is cut in the middle.
struct LargePlan {
  std::size_t side = 0;
  int process = 0;
};
std::size_t tetrahedra_of(std::size_t side);

/// One part in one process.
struct LargeTime {
  std::size_t side = 0;
  int process = 0;
  std::string part;
  double seconds = 0.0;        // by the clock
  double bytes = 0.0;          // of what the part leaves; 0 for one that is not about memory or files
  double limit_seconds = 0.0;  // to copy as many bytes from memory to memory; of files, to write or read them
};
void to_json(nlohmann::json& json, const LargeTime& time);
void from_json(const nlohmann::json& json, LargeTime& time);

/// One body in one process, its cut and its memory.
struct LargeCounts {
  std::size_t side = 0, vertices = 0, springs = 0;
  std::size_t operations = 0, components = 0;  // of the cut
  bool keeps_mass = false;                     // to the bit
  std::string violation{};                     // of the map, afterwards
  std::size_t bytes = 0;                       // of all parts of the run, as `explain` lists them
  std::size_t bytes_without_events = 0;        // the same for a scene without events
  std::size_t peak_bytes = 0;                  // of the process, once the simulation is made
};
void to_json(nlohmann::json& json, const LargeCounts& counts);
void from_json(const nlohmann::json& json, LargeCounts& counts);

/// All parts but those of `measure_large_start`.
/// throws  IoError where there is no room for the files
void measure_large(const LargePlan& plan, const std::function<void(const LargeTime&)>& time,
                   const std::function<void(const LargeCounts&)>& counts);

/// What a user waits for: a run with its files until its first step, and `mesh info` of a frame.
void measure_large_start(const LargePlan& plan, const std::function<void(const LargeTime&)>& time);

}  // namespace dartboard
