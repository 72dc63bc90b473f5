#include "benchmarks/harness/manifest.h"

#include <cholmod.h>
#include <dlfcn.h>
#include <fmt/core.h>
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <boost/version.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/processes.h"
#include "core/plain/error.h"

#if !defined(DARTBOARD_VERSION) || !defined(DARTBOARD_FLAGS) || !defined(DARTBOARD_BUILD_TYPE)
#error "the build must define DARTBOARD_VERSION, DARTBOARD_FLAGS and DARTBOARD_BUILD_TYPE"
#endif

namespace dartboard {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

template <class T>
json or_null(const std::optional<T>& value) {
  return value ? json(*value) : json(nullptr);
}

std::optional<std::string> first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line)) return std::nullopt;
  return line;
}

// ---------------------------------------------------------------------------------------------------------- the build

std::string compiler() {
#if defined(__clang__)
  return "clang " __clang_version__;
#elif defined(__GNUC__)
  return "gcc " __VERSION__;
#else
  return "unknown";
#endif
}

json build() {
  return {{"compiler", compiler()},
          {"type", DARTBOARD_BUILD_TYPE},
          {"flags", published_command(DARTBOARD_FLAGS)},
          {"assertions",
#ifdef NDEBUG
           false
#else
           true
#endif
          }};
}

std::string dotted(int major, int minor, int patch) { return fmt::format("{}.{}.{}", major, minor, patch); }

json libraries(const std::map<std::string, std::string>& known_to_caller) {
  json versions = known_to_caller;
  versions["Boost"] = dotted(BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100);
  versions["CHOLMOD"] = dotted(CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION);
  versions["Eigen"] = dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  versions["SuiteSparse"] = dotted(SUITESPARSE_MAIN_VERSION, SUITESPARSE_SUB_VERSION, SUITESPARSE_SUBSUB_VERSION);
  versions["fmt"] = dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
  versions["nlohmann-json"] =
      dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
  return versions;
}

/// A function of a library that this program has loaded, directly or not; null if no function has that name.
template <class Function>
Function* loaded(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// The BLAS chosen by the dynamic linker: the package manager can exchange it without a new build.
json blas() {
  json result{{"name", nullptr}, {"threads", nullptr}};
  if (auto* config = loaded<char*()>("openblas_get_config")) result["name"] = config();
  if (auto* threads = loaded<int()>("openblas_get_num_threads")) result["threads"] = threads();
  if (!result["name"].is_null()) return result;
  // another BLAS: the folder of its library identifies it ("blas/libblas.so.3.11.0" is the reference)
  result["name"] = or_null(library_of(dlsym(RTLD_DEFAULT, "dgemm_")));
  return result;
}

// -------------------------------------------------------------------------------------------------------- the machine

std::optional<std::string> cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != line.npos) return line.substr(colon + 2);
  }
  return std::nullopt;
}

/// "L1 Data": "32K", ... of the first core.
json caches() {
  json sizes = json::object();
  for (int i = 0; i < 16; ++i) {
    const fs::path cache = fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}", i);
    const auto level = first_line(cache / "level"), type = first_line(cache / "type");
    const auto size = first_line(cache / "size");
    if (level && type && size) sizes[fmt::format("L{} {}", *level, *type)] = *size;
  }
  return sizes.empty() ? json(nullptr) : sizes;
}

json usable_cores() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? json(CPU_COUNT(&set)) : json(nullptr);
}

json load_average() {
  std::array<double, 3> load{};
  return getloadavg(load.data(), 3) == 3 ? json(load) : json(nullptr);
}

json machine() {
  utsname system{};
  const bool known = uname(&system) == 0;
  return {{"cpu", or_null(cpu_model())},
          {"cores", sysconf(_SC_NPROCESSORS_ONLN)},
          {"cores_usable", usable_cores()},
          {"caches", caches()},
          {"memory_bytes", static_cast<std::int64_t>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE)},
          {"governor", or_null(first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor"))},
          // 0 would make every process the same draw, and the intervals over processes too narrow
          {"address_randomization", or_null(first_line("/proc/sys/kernel/randomize_va_space"))},
          {"kernel", known ? json(fmt::format("{} {} {}", system.sysname, system.release, system.machine)) : json()}};
}

// --------------------------------------------------------------------------------------------------------- the inputs

json input_files(const std::vector<fs::path>& files) {
  json list = json::array();
  for (const fs::path& file : files) list.push_back({{"file", published_path(file)}, {"hash", file_hash(file)}});
  return list;
}

json command_line(const std::vector<std::string>& words) {
  json list = json::array();
  for (const std::string& word : words) list.push_back(published_command(word));
  return list;
}

std::string published_word(const std::string& word) {
  const std::size_t slash = word.find('/');
  if (slash == std::string::npos) return word;
  const bool starts_path = slash == 0 || word[slash - 1] == '=' || (slash == 2 && word[0] == '-');
  return starts_path ? word.substr(0, slash) + published_path(word.substr(slash)) : word;
}

/// The output of git, or nothing if it fails.
std::optional<std::vector<std::string>> git(const fs::path& folder, std::vector<std::string> arguments) {
  // without optional locks: a measurement must not disturb a commit of the user
  arguments.insert(arguments.begin(), {"--no-optional-locks", "-C", folder.string()});
  std::vector<std::string> lines;
  try {
    run_program(
        "git", arguments, [&](std::string_view line) { lines.emplace_back(line); }, Stderr::discarded);
  } catch (const ProcessError&) {
    return std::nullopt;
  }
  return lines;
}

}  // namespace

std::optional<std::string> library_of(const void* function) {
  Dl_info info{};
  if (function == nullptr || dladdr(function, &info) == 0) return std::nullopt;
  std::error_code error;
  const fs::path library = fs::canonical(info.dli_fname, error);
  if (error) return std::nullopt;
  return (library.parent_path().filename() / library.filename()).string();
}

json git_state(const fs::path& folder) {
  json state{{"commit", nullptr}, {"dirty", nullptr}};
  const auto commit = git(folder, {"rev-parse", "HEAD"});
  // sources unpacked somewhere inside another repository would otherwise report a commit of that one
  const auto prefix = git(folder, {"rev-parse", "--show-prefix"});
  const bool is_root = prefix && (prefix->empty() || prefix->front().empty());
  if (!commit || commit->empty() || !is_root) return state;
  state["commit"] = commit->front();
  if (const auto changes = git(folder, {"status", "--porcelain", "--", ".", ":(exclude)results"}))
    state["dirty"] = !changes->empty();
  return state;
}

std::string file_hash(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw IoError(fmt::format("{}: cannot be read", file.string()));
  std::uint64_t hash = 0xcbf29ce484222325;
  for (std::array<char, 65536> block; stream.read(block.data(), block.size()), stream.gcount() > 0;)
    for (std::streamsize i = 0; i < stream.gcount(); ++i) {
      hash ^= static_cast<unsigned char>(block[static_cast<std::size_t>(i)]);
      hash *= 0x100000001b3;
    }
  // a folder can be opened, but not read
  if (stream.bad()) throw IoError(fmt::format("{}: cannot be read, expected a file", file.string()));
  return fmt::format("fnv1a64:{:016x}", hash);
}

std::string published_path(const fs::path& path) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  const fs::path full = (here / path).lexically_normal();
  for (const fs::path& root : {source_folder(), here}) {
    // everything lies below "/": a path relative to it hides nothing
    if (!root.has_relative_path()) continue;
    const fs::path relative = full.lexically_relative(root);
    if (!relative.empty() && *relative.begin() != "..") return relative.string();
  }
  return full.has_filename() ? full.filename().string() : full.parent_path().filename().string();
}

std::string published_command(std::string_view words) {
  std::string result;
  for (std::size_t start = 0; start <= words.size();) {
    const std::size_t end = std::min(words.find(' ', start), words.size());
    if (start > 0) result += ' ';
    result += published_word(std::string(words.substr(start, end - start)));
    start = end + 1;
  }
  return result;
}

json begin_manifest(const RunFacts& facts) {
  return {{"dartboard", DARTBOARD_VERSION},
          {"git", git_state(source_folder())},
          {"command_line", command_line(facts.command_line)},
          {"seeds", facts.seeds},
          {"inputs", input_files(facts.input_files)},
          {"build", build()},
          {"libraries", libraries(facts.libraries)},
          {"blas", blas()},
          {"machine", machine()},
          {"started", {{"utc", utc_time()}, {"load_average", load_average()}}}};
}

void finish_manifest(json& manifest) { manifest["finished"] = {{"utc", utc_time()}, {"load_average", load_average()}}; }

}  // namespace dartboard
