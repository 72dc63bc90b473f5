# Objects come from ccache if it is installed and no other launcher is set: a second checkout, or a branch that was
# built before, costs little more than linking. Nothing else depends on it.
option(DARTBOARD_CACHE "Take objects from ccache where it is installed" ON)
find_program(DARTBOARD_CCACHE ccache)
mark_as_advanced(DARTBOARD_CCACHE)
if(NOT DARTBOARD_CACHE OR NOT DARTBOARD_CCACHE OR NOT PROJECT_IS_TOP_LEVEL OR CMAKE_CXX_COMPILER_LAUNCHER)
  return()
endif()
# Paths below the checkout are hashed as relative ones, without the build folder. Precompiled headers need this
# sloppiness; our sources use no __TIME__.
set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
  CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${DARTBOARD_CCACHE})
message(STATUS "Objects are taken from and kept by ${DARTBOARD_CCACHE}")
# Headers precompiled by Clang contain the folder that they were made in, so that no later object would be found in the cache.
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  set(DARTBOARD_PRECOMPILE OFF)
endif()
