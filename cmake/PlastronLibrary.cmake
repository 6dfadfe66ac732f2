# plastron_library(NAME folder DEPENDS other folders EXTERNAL third-party targets PRIVATE_EXTERNAL ... PRECOMPILED headers
#                  OWN_HEADERS headers that are not installed SEPARATE files that are compiled by themselves
#                  PART_OF folder FILES some of its files)
#
# One target per folder of src/plastron; with PART_OF, one for some of a folder's files, which others then use without all that the folder
# needs: the folder's own target, which comes after it, has the rest of the files and DEPENDS on the part. A target sees its own headers and those of the folders it
# DEPENDS on, and no others: its include root is a directory in the build tree that holds one link,
# plastron/<folder>. A forbidden include therefore does not compile. Other programs see the target as Plastron::<folder>, with all
# headers in one root; our warnings and precompiled headers stay here.
add_library(plastron_warnings INTERFACE)
target_compile_options(plastron_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Werror
  # False alarms on std::string in g++ 12 (GCC bugs 105329, 105651); the sanitizers look after bounds. clang's -Wshadow also compares with
  # names of other files of a batch.
  "$<$<CXX_COMPILER_ID:GNU>:-Wshadow;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-array-bounds>")

function(plastron_library name)
  cmake_parse_arguments(ARG "" "PRECOMPILED;PART_OF" "DEPENDS;EXTERNAL;PRIVATE_EXTERNAL;OWN_HEADERS;SEPARATE;FILES" ${ARGN})
  set(folder ${name})
  if(ARG_PART_OF)
    set(folder ${ARG_PART_OF})
  endif()
  set(root ${PROJECT_BINARY_DIR}/include/${folder})
  file(MAKE_DIRECTORY ${root}/plastron)
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${folder} ${root}/plastron/${folder} SYMBOLIC)
  if(ARG_PART_OF)
    list(TRANSFORM ARG_FILES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/ OUTPUT_VARIABLE sources)
    set_property(DIRECTORY APPEND PROPERTY plastron_files_of_parts ${sources})
  else()
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cc)
    get_property(taken DIRECTORY PROPERTY plastron_files_of_parts)
    list(REMOVE_ITEM sources ${taken})
  endif()
  if(sources)
    add_library(plastron_${name} STATIC ${sources})
    list(TRANSFORM ARG_SEPARATE PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/)
    plastron_unity(plastron_${name} SEPARATE ${ARG_SEPARATE})
    set(scope PUBLIC)
    target_link_libraries(plastron_${name} PRIVATE $<BUILD_INTERFACE:plastron_warnings> ${ARG_PRIVATE_EXTERNAL})
    if(ARG_PRECOMPILED)
      plastron_use_precompiled(plastron_${name} plastron_precompiled_${ARG_PRECOMPILED})
    endif()
    if(ARG_PRECOMPILED STREQUAL edge)
      target_compile_options(plastron_${name} PRIVATE ${plastron_edge_options})
    endif()
  else()
    add_library(plastron_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(plastron_${name} ${scope} $<BUILD_INTERFACE:${root}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(plastron_${name} ${scope} cxx_std_20)
  foreach(dependency IN LISTS ARG_DEPENDS)
    target_link_libraries(plastron_${name} ${scope} plastron_${dependency})
  endforeach()
  target_link_libraries(plastron_${name} ${scope} ${ARG_EXTERNAL})
  set_target_properties(plastron_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS plastron_${name} EXPORT PlastronTargets)
  if(ARG_PART_OF)
    return()  # the folder's own target installs the headers
  endif()
  set(own_headers ${ARG_OWN_HEADERS})
  list(TRANSFORM own_headers REPLACE "(.+)" "PATTERN;\\1;EXCLUDE")
  install(DIRECTORY ${name} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plastron FILES_MATCHING PATTERN "*.hpp" ${own_headers})
endfunction()
