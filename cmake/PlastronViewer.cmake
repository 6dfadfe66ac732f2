# plastron_embed_page(target): links viewer/src/page.html, viewer/src/style.css and the script of report.html's three-dimensional view into a
# target. The script is bundled from viewer/src with vtk.js by esbuild while other files compile: `npm ci` runs only when
# viewer/package-lock.json has changed, esbuild when a source has. The packages stand in the build tree, so a second build needs no network.
option(PLASTRON_VIEWER "The three-dimensional view of report.html; needs npm to build" ON)
enable_language(ASM)
# Packages are taken as the lock file says, by their hashes, and run nothing when they are installed.
set(plastron_npm_options --no-audit --no-fund --no-progress --prefer-offline --ignore-scripts --loglevel=error)
# Behind a proxy whose certificate it does not know npm tries for many minutes; twenty seconds are usual.
set(plastron_npm_in_time [[timeout --signal=KILL 180 "$@" || (echo "npm did not fetch vtk.js and esbuild (time limit: 3 minutes). Behind a proxy with its own certificate set NODE_EXTRA_CA_CERTS=FILE.pem. Or build without the 3D view of report.html: cmake --preset release -DPLASTRON_VIEWER=OFF" >&2 && exit 1)]])

function(plastron_bundle_viewer script)
  find_program(PLASTRON_NPM npm)
  find_program(PLASTRON_NODE NAMES node nodejs)
  if(NOT PLASTRON_NPM OR NOT PLASTRON_NODE)
    message(FATAL_ERROR "npm is not found, which bundles the three-dimensional view of report.html. Install it (scripts/install-dependencies does: "
                        "Debian's nodejs and npm), or configure with -DPLASTRON_VIEWER=OFF: reports then have everything but that view.")
  endif()
  set(viewer ${PROJECT_SOURCE_DIR}/viewer)
  set(build ${PROJECT_BINARY_DIR}/viewer)
  set(installed ${build}/node_modules/.package-lock.json)
  file(GLOB sources CONFIGURE_DEPENDS ${viewer}/src/*.js)
  file(MAKE_DIRECTORY ${build})
  add_custom_command(OUTPUT ${installed}
                     COMMAND ${CMAKE_COMMAND} -E copy ${viewer}/package.json ${viewer}/package-lock.json ${build}
                     COMMAND sh -c "${plastron_npm_in_time}" npm ${PLASTRON_NPM} ci ${plastron_npm_options} --omit=peer --fetch-retries=3 --fetch-retry-maxtimeout=10000 --fetch-timeout=30000
                     COMMAND ${CMAKE_COMMAND} -E touch ${installed}
                     DEPENDS ${viewer}/package.json ${viewer}/package-lock.json
                     WORKING_DIRECTORY ${build} COMMENT "Installing vtk.js and esbuild for report.html (npm ci)" VERBATIM)
  add_custom_command(OUTPUT ${script} ${script}.source
                     COMMAND ${PLASTRON_NODE} ${viewer}/build.mjs ${build} ${script}
                     DEPENDS ${installed} ${viewer}/build.mjs ${sources} WORKING_DIRECTORY ${build} COMMENT "Bundling the view of report.html" VERBATIM)
endfunction()

function(plastron_embed_page target)
  set(plastron_page ${PROJECT_SOURCE_DIR}/viewer/src/page.html)
  set(plastron_style ${PROJECT_SOURCE_DIR}/viewer/src/style.css)
  set(plastron_script ${PROJECT_BINARY_DIR}/viewer/viewer.js)
  if(PLASTRON_VIEWER)
    plastron_bundle_viewer(${plastron_script})
  else()
    set(plastron_script ${PROJECT_BINARY_DIR}/viewer/none.js)
    file(WRITE ${plastron_script} "")
    file(WRITE ${plastron_script}.source "'none'")
  endif()
  set(assembly ${PROJECT_BINARY_DIR}/viewer/embedded_page.S)
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/embedded_page.S.in ${assembly} @ONLY)
  set_source_files_properties(${assembly} PROPERTIES OBJECT_DEPENDS "${plastron_page};${plastron_style};${plastron_script};${plastron_script}.source")
  target_sources(${target} PRIVATE ${assembly})
endfunction()
