# Warnings, sanitizers and the helper every library of the project is made with.

# Found here, at the root, so that every folder sees the imported targets.
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Threads REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(LLVM 19.1 REQUIRED CONFIG)
find_package(mimalloc 2.0 REQUIRED)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  # The cache must trust precompiled headers by their contents, not by their time.
  set(CCACHE_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CCACHE_PROGRAM})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_LAUNCHER})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_LAUNCHER})
endif()

# Compiled programs need x86-64-v2 in any case. Without errno of math.h, roots and roundings are single instructions. Neither changes a
# result.
add_compile_options(-fno-math-errno)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  add_compile_options(-march=x86-64-v2)
endif()

option(RAPIDC_SANITIZE "Build with the address and undefined-behaviour sanitizers" OFF)
option(RAPIDC_FUZZ "Build the libFuzzer targets (needs clang)" OFF)
option(RAPIDC_COVERAGE "Instrument for coverage reports" OFF)
option(RAPIDC_UNITY "Compile the files of a folder together: faster from nothing, slower after a change of one file" OFF)
set(RAPIDC_ALONE "" CACHE STRING "With RAPIDC_UNITY: folders whose files are compiled alone all the same, as codegen;frontend/sema")

# The compiler need not be fast to the last percent: -O2 takes less time to build. Only the programs have to be fast, and
# LLVM optimises those.
string(REPLACE "-O3" "-O2" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
string(REPLACE "-O3" "-O2" CMAKE_C_FLAGS_RELEASE "${CMAKE_C_FLAGS_RELEASE}")

add_library(rapidc_options INTERFACE)
target_compile_options(rapidc_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Werror
  -ffp-contract=off $<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp> $<$<CXX_COMPILER_ID:Clang>:-fcolor-diagnostics>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC bugs 105329 and 105651: reports overlapping, endless or misplaced copies in std::string that cannot happen.
  # GCC 12 takes the small form of LLVM's hash tables for uninitialised; LLVM's own build leaves that warning out as well.
  target_compile_options(rapidc_options INTERFACE -Wno-restrict -Wno-stringop-overflow
    -Wno-stringop-overread -Wno-array-bounds -Wno-maybe-uninitialized)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # hints for the bitcode of natives, which clang makes in any case
  target_compile_options(rapidc_options INTERFACE -Wno-unknown-pragmas)
endif()
if(RAPIDC_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
if(RAPIDC_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
if(RAPIDC_COVERAGE)
  add_compile_options(-fprofile-instr-generate -fcoverage-mapping)
  add_link_options(-fprofile-instr-generate)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  add_link_options(-fuse-ld=lld -Wl,-z,pack-relative-relocs) # short tables of relocations: programs start sooner
endif()

set(STANDARD_HEADERS ${CMAKE_CURRENT_LIST_DIR}/standard_headers.h)

# fmt without its shared library, and the precompiled headers that other targets reuse.
add_library(rapidc_fmt STATIC ${CMAKE_CURRENT_LIST_DIR}/fmt_compiled.cpp)
target_link_libraries(rapidc_fmt PRIVATE rapidc_options nlohmann_json::nlohmann_json)
target_precompile_headers(rapidc_fmt PRIVATE ${STANDARD_HEADERS})

# rapidc_precompiled(TARGET [OWNER]): includes the headers that OWNER has precompiled, by default the standard headers. All
# who share them need the same code model, so executables are compiled like libraries.
function(rapidc_precompiled target)
  set(owner rapidc_fmt)
  if(ARGN AND NOT RAPIDC_UNITY) # with it, only the standard headers are precompiled
    list(GET ARGN 0 owner)
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${target} PRIVATE -fPIC)
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()

# rapidc_precompile(TARGET HEADER...): precompiles these besides the standard headers. With RAPIDC_UNITY they are read once in a folder,
# and the standard ones are sufficient.
function(rapidc_precompile target)
  if(RAPIDC_UNITY)
    rapidc_precompiled(${target})
  else()
    target_precompile_headers(${target} PRIVATE ${STANDARD_HEADERS} ${ARGN})
  endif()
endfunction()

# rapidc_library(NAME DIRS dir... DEPS lib...): a static library of all .cpp files below the given
# folders (relative to the current one). PRECOMPILED header...: besides the standard headers. PRECOMPILED_BY lib: takes over
# those of another library.
function(rapidc_library name)
  cmake_parse_arguments(ARG "" "PRECOMPILED_BY" "DIRS;DEPS;PRECOMPILED" ${ARGN})
  set(sources)
  foreach(dir ${ARG_DIRS})
    file(GLOB found CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${dir}/*.cpp)
    list(APPEND sources ${found})
  endforeach()
  if(sources)
    add_library(${name} STATIC ${sources})
    target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
    target_link_libraries(${name} PRIVATE rapidc_options PUBLIC ${ARG_DEPS})
    if(ARG_PRECOMPILED)
      rapidc_precompile(${name} ${ARG_PRECOMPILED})
    else()
      rapidc_precompiled(${name} ${ARG_PRECOMPILED_BY})
    endif()
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${CMAKE_SOURCE_DIR})
    target_link_libraries(${name} INTERFACE ${ARG_DEPS})
  endif()
endfunction()

# rapidc_embed_files(TARGET space::function header.h file...): the texts of the files, in this order, as the result of a function
# `std::span<const std::string_view> function()` that the header declares. They become a source of the target.
function(rapidc_embed_files target function header)
  string(REPLACE "::" "_" stem ${function})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_${stem}.cpp)
  list(JOIN ARGN "|" files)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DFUNCTION=${function}" "-DHEADER=${header}" "-DFILES=${files}" "-DOUTPUT=${output}"
      -P ${CMAKE_SOURCE_DIR}/cmake/embed_files.cmake
    DEPENDS ${ARGN} ${CMAKE_SOURCE_DIR}/cmake/embed_files.cmake VERBATIM)
  add_custom_target(embedded_${stem} DEPENDS ${output}) # otherwise it waits for the libraries of the target
  target_sources(${target} PRIVATE ${output})
endfunction()
