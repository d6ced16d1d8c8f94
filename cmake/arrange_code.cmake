# rapidc_arrange_code(TARGET ARCHIVE): rewrites the machine code of a linked library, so that the blocks that ran
# together when ARCHIVE was recorded lie together (decision 139). `cmake -P` of this file is that step: -DBOLT, -DLIBRARY, -DPROFILE.

if(NOT CMAKE_SCRIPT_MODE_FILE)
  option(RAPIDC_ARRANGE "Arrange the machine code of the code generator by the recorded profile (needs llvm-bolt)" OFF)
  find_program(RAPIDC_BOLT NAMES llvm-bolt PATHS ${LLVM_TOOLS_BINARY_DIR} NO_DEFAULT_PATH)
  mark_as_advanced(RAPIDC_BOLT)

  function(rapidc_arrange_code target archive)
    if(NOT RAPIDC_ARRANGE OR NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
      return()
    endif()
    if(NOT RAPIDC_BOLT)
      message(WARNING "llvm-bolt is not installed (package bolt-19): rapidc will compile programs a quarter more slowly")
      return()
    endif()
    get_filename_component(name ${archive} NAME_WE)
    set(profile ${CMAKE_CURRENT_BINARY_DIR}/${name}.fdata)
    # the relocations let llvm-bolt move functions; it cannot read packed ones
    target_link_options(${target} PRIVATE -Wl,--emit-relocs -Wl,-z,nopack-relative-relocs)
    file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${CMAKE_CURRENT_BINARY_DIR})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${archive})
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${profile} ${CMAKE_CURRENT_FUNCTION_LIST_FILE})
    add_custom_command(TARGET ${target} POST_BUILD
      COMMAND ${CMAKE_COMMAND} -DBOLT=${RAPIDC_BOLT} -DLIBRARY=$<TARGET_FILE:${target}> -DPROFILE=${profile}
        -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE} VERBATIM)
  endfunction()
  return()
endif()

# Kept: scripts/record_layout_profile.sh instruments it.
set(linked ${PROFILE}.linked.so)
file(RENAME ${LIBRARY} ${linked})
execute_process(
  COMMAND ${BOLT} ${linked} -o ${LIBRARY} -data=${PROFILE} -reorder-blocks=ext-tsp -reorder-functions=cdsort -split-functions
    -split-all-cold
  OUTPUT_FILE ${PROFILE}.log ERROR_FILE ${PROFILE}.log RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  file(COPY_FILE ${linked} ${LIBRARY})
  message(WARNING "llvm-bolt failed (${status}; see ${PROFILE}.log): ${LIBRARY} is used as it was linked")
endif()
