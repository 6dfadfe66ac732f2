# plastron_wider_instructions(folder file options): compiles a file of a folder for instructions that not every processor has; the program asks
# the processor before it calls anything in it. Such a file has no precompiled headers, which were compiled with other options, and
# instantiates nothing that other files instantiate: the linker would keep either version. Square roots may not set errno, or they would be taken one by one.
function(plastron_wider_instructions folder file options)
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(options "")
  endif()
  set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/${folder}/${file} PROPERTIES
                              COMPILE_OPTIONS "-fno-math-errno;${options}" SKIP_PRECOMPILE_HEADERS ON)
endfunction()
