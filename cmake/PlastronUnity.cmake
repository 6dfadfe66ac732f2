# plastron_unity(target SEPARATE files...): the files of a target are compiled in batches, with PLASTRON_UNITY_BUILD. Half of a build is
# reading the headers of others and instantiating their templates, which a batch does once. Files of one target share a namespace, so
# names in their anonymous namespaces must differ; files where they had better be alike are SEPARATE, and so are those that the front
# program `plastron` takes from folders that it must not load whole.
function(plastron_unity target)
  cmake_parse_arguments(ARG "" "" "SEPARATE" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${PLASTRON_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE ${PLASTRON_UNITY_BATCH})
  set_source_files_properties(${ARG_SEPARATE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
