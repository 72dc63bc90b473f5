# Flags for all our targets. They are properties of a target, never in CMAKE_CXX_FLAGS, so that projects that add this
# one as a subdirectory do not inherit them.
add_library(dartboard_options INTERFACE)
target_compile_features(dartboard_options INTERFACE cxx_std_20)
target_include_directories(dartboard_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(dartboard_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual)
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  # with Clang -Wconversion warns of signs too, as in arithmetic with Eigen's signed and the library's unsigned sizes
  target_compile_options(dartboard_options INTERFACE -Wno-sign-conversion)
endif()
if(PROJECT_IS_TOP_LEVEL)  # another compiler may have further warnings
  target_compile_options(dartboard_options INTERFACE -Werror)
endif()
# The walks promise equal bits. Fusing a*b+c changes bits, and is the only such transformation on by default ...
set(equal_bits -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # ... and GCC 12's SLP vectoriser fuses an add/sub pair in spite of it on targets that have FMA.
  include(CheckCXXSourceCompiles)
  check_cxx_source_compiles("#if !defined(__FMA__) && !defined(__AVX512F__)\n#error none\n#endif\nint main() {}" DARTBOARD_HAS_FMA)
  if(DARTBOARD_HAS_FMA)
    list(APPEND equal_bits -fno-tree-slp-vectorize)
  endif()
endif()
# Eigen would sum in packets as wide as the target's registers, call fused instructions by itself, which no flag of the
# compiler prevents, and without packets sum by halves. Without its packets and its unrolling, sums are taken in the order
# of their terms, and compilers unroll the loops. Projects that link to us see these definitions, too: both sides share
# inline functions, and types that Eigen would align as packets need.
set(dartboard_eigen_definitions)
if(DARTBOARD_EQUAL_BITS)
  set(dartboard_eigen_definitions EIGEN_DONT_VECTORIZE EIGEN_UNROLLING_LIMIT=0)
  target_compile_definitions(dartboard_options INTERFACE ${dartboard_eigen_definitions})
  target_compile_options(dartboard_options INTERFACE ${equal_bits})
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # false alarms on "literal" + std::string at -O3 (GCC bug 105651)
  target_compile_options(dartboard_options INTERFACE -Wno-restrict)
endif()
if(DARTBOARD_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # a precompiled header is no longer known to be a library's, so false alarms in std::string and Eigen are shown
  target_compile_options(dartboard_options INTERFACE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()

if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # GCC would look through its memory for what it no longer needs from 128 MB on, which is a tenth of the time to compile
  target_compile_options(dartboard_options INTERFACE --param=ggc-min-heapsize=524288)
endif()

# Under sanitizers compiling takes most of the time: twice as long with the checks of undefined behaviour as with those
# of addresses alone. So the former are for code that computes (dartboard_folder), the latter for everything.
if(DARTBOARD_SANITIZE)
  target_compile_options(dartboard_options INTERFACE -fsanitize=address -fno-omit-frame-pointer)
  target_link_options(dartboard_options INTERFACE -fsanitize=address,undefined)
  set(dartboard_undefined -fsanitize=undefined -fno-sanitize-recover=all)
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    set(unchecked ${CMAKE_CURRENT_LIST_DIR}/unchecked.txt)
    if(CMAKE_GENERATOR STREQUAL Ninja)  # a path that is the same in every checkout, for ccache
      file(RELATIVE_PATH unchecked ${CMAKE_BINARY_DIR} ${unchecked})
    endif()
    list(APPEND dartboard_undefined -fsanitize-ignorelist=${unchecked})
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # instrumented code hides what is initialised, so GCC raises false alarms, here in <regex>; the release build keeps the warning
    target_compile_options(dartboard_options INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()
if(DARTBOARD_COVERAGE)
  target_compile_options(dartboard_options INTERFACE --coverage)
  target_link_options(dartboard_options INTERFACE --coverage)
endif()

# dartboard_precompile(NAME [LIGHT] HEADERS...): a precompiled header for the folders added after it in this room:
# the headers that most of their sources include and that cost most to read. LIGHT headers and folders are compiled with
# -O1: none of their code takes long to run, and optimising would be most of the time to compile them.
set(dartboard_light $<$<CONFIG:Release>:-O1>)
if(DARTBOARD_SANITIZE)
  set(dartboard_light -O0)
endif()
function(dartboard_precompile name)
  cmake_parse_arguments(ARG "LIGHT" "" "" ${ARGN})
  if(DARTBOARD_PRECOMPILE)
    file(WRITE ${PROJECT_BINARY_DIR}/${name}.cpp "")
    add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/${name}.cpp)
    target_link_libraries(${name} PRIVATE dartboard_options Eigen3::Eigen fmt::fmt)
    target_precompile_headers(${name} PRIVATE <algorithm> <functional> <map> <span> <string> <vector> <fmt/format.h>
      <Eigen/Geometry> ${ARG_UNPARSED_ARGUMENTS})
    if(ARG_LIGHT)
      target_compile_options(${name} PRIVATE ${dartboard_light})
    endif()
    set(dartboard_precompiled ${name} PARENT_SCOPE)
  endif()
endfunction()

# dartboard_libraries(VARIABLE NAMES...): the targets of folders; other names stay unchanged.
function(dartboard_libraries variable)
  set(libraries)
  foreach(name IN LISTS ARGN)
    if(name MATCHES "^(core|reference|validation|benchmarks)(/|$)")
      string(REPLACE "/" "_" name dartboard_${name})
      if(NOT TARGET ${name})
        message(FATAL_ERROR "There is no folder ${name} yet: folders see only what stands above them")
      endif()
    endif()
    list(APPEND libraries ${name})
  endforeach()
  set(${variable} ${libraries} PARENT_SCOPE)
endfunction()

# dartboard_sees(PATH FOLDERS...): the folders that the files of a folder may include, for the test that reads them.
function(dartboard_sees path)
  list(JOIN ARGN " " folders)
  set_property(GLOBAL APPEND_STRING PROPERTY dartboard_folders "${path}: ${folders}\n")
endfunction()

# dartboard_folder(PATH [SEES FOLDERS...] [LINK LIBRARIES...] [LIGHT] [TOGETHER [APART SOURCES...]] [NOT_PRECOMPILED])
#
# TOGETHER: if DARTBOARD_TOGETHER is on, its sources are compiled eight at a time, which saves most of the time to read
# headers; those APART are not, because they define names that others define, too. Not for kernels: inlining, and so
# the instruction counts, would depend on their neighbours.
#
# A library of the sources in a folder, not of those below it. SEES lists the folders that its files may include, besides
# core/plain, which all may, and core/base, which all but the witnesses of reference may; tests/program/includes_test.cpp
# checks that, and that each folder listed is added before it, so that there is no circle.
function(dartboard_folder path)
  cmake_parse_arguments(ARG "NOT_PRECOMPILED;LIGHT;TOGETHER" "" "SEES;LINK;APART" ${ARGN})
  dartboard_sees(${path} ${ARG_SEES})
  string(REPLACE "/" "_" target dartboard_${path})
  set_property(GLOBAL APPEND PROPERTY dartboard_targets ${target})
  if(NOT path STREQUAL core/plain)
    list(APPEND ARG_SEES core/plain)
  endif()
  if(NOT path MATCHES "^(core/plain|core/base|reference.*)$")
    list(APPEND ARG_SEES core/base)
  endif()
  dartboard_libraries(libraries ${ARG_SEES})
  file(GLOB sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/${path}/*.cpp)
  if(NOT sources)
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${target} INTERFACE ${libraries} ${ARG_LINK})
    return()
  endif()
  add_library(${target} STATIC ${sources})
  # our flags are for our sources alone, not for those of projects that link to them
  target_compile_options(${target} PRIVATE $<TARGET_PROPERTY:dartboard_options,INTERFACE_COMPILE_OPTIONS>)
  if(ARG_LIGHT)
    target_compile_options(${target} PRIVATE ${dartboard_light})
  endif()
  if(ARG_TOGETHER AND DARTBOARD_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    list(TRANSFORM ARG_APART PREPEND ${PROJECT_SOURCE_DIR}/${path}/)
    set_source_files_properties(${ARG_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
      # a file-local name of one source is no outer scope of the next; lint reads each by itself
      target_compile_options(${target} PRIVATE -Wno-shadow)
    endif()
  endif()
  if(NOT path MATCHES "^benchmarks/|/cgal$")
    target_compile_options(${target} PRIVATE ${dartboard_undefined})
  endif()
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PUBLIC ${libraries} ${ARG_LINK})
  if(DARTBOARD_PRECOMPILE AND NOT ARG_NOT_PRECOMPILED)
    target_precompile_headers(${target} REUSE_FROM ${dartboard_precompiled})
  endif()
endfunction()
