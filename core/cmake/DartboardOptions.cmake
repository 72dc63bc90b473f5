# Flags every target of ours is built with. They live on a target, never in CMAKE_CXX_FLAGS, so that nobody who adds
# the project as a subdirectory inherits them.
add_library(dartboard_options INTERFACE)
target_compile_features(dartboard_options INTERFACE cxx_std_20)
target_include_directories(dartboard_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(dartboard_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
# The walks promise equal bits. Fusing a*b+c changes bits, and is the one such transform on by default ...
set(equal_bits -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # ... and GCC 12's SLP vectoriser fuses an add/sub pair in spite of it on targets that have FMA.
  list(APPEND equal_bits -fno-tree-slp-vectorize)
endif()
# Eigen calls fused instructions by itself where the target has them, which no flag of the compiler stops, and sums as
# many numbers at once as fit the target's registers. So it is shown a target that has SSE alone.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("#if !defined(__AVX__) && !defined(__FMA__)\n#error none\n#endif\nint main() {}"
  DARTBOARD_WIDE_VECTORS)
if(DARTBOARD_WIDE_VECTORS)
  list(APPEND equal_bits -U__AVX__ -U__AVX2__ -U__AVX512F__ -U__FMA__)
endif()
if(DARTBOARD_EQUAL_BITS)
  target_compile_options(dartboard_options INTERFACE ${equal_bits})
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # false alarms on "literal" + std::string at -O3 (GCC bug 105651)
  target_compile_options(dartboard_options INTERFACE -Wno-restrict)
endif()
if(DARTBOARD_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # what a precompiled header brings is no longer known to be the library's, so false alarms in std::string and Eigen show
  target_compile_options(dartboard_options INTERFACE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()

if(DARTBOARD_SANITIZE)
  target_compile_options(dartboard_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(dartboard_options INTERFACE -fsanitize=address,undefined)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # instrumented code hides what is initialised, so GCC raises false alarms, here in <regex>; the release build keeps the warning
    target_compile_options(dartboard_options INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()
if(DARTBOARD_COVERAGE)
  target_compile_options(dartboard_options INTERFACE --coverage)
  target_link_options(dartboard_options INTERFACE --coverage)
endif()

# dartboard_library(NAME SOURCES... [LINK LIBS...]): a static library of ours.
function(dartboard_library name)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PUBLIC dartboard_options ${ARG_LINK})
  if(DARTBOARD_PRECOMPILE)
    target_precompile_headers(${name} PRIVATE <algorithm> <functional> <map> <span> <string> <vector>
      <fmt/format.h> <Eigen/Geometry>)
  endif()
endfunction()
