# rinkaku_embed_text(TARGET FILES...): for each file dir/name.ext a header "embedded/name.ext.h" is generated, which
# defines `inline constexpr std::string_view name_ext` in rinkaku::embedded. Shaders lie beside the code that uses them.
function(rinkaku_embed_text target)
  set(out_dir "${CMAKE_CURRENT_BINARY_DIR}/embed")
  foreach(file ${ARGN})
    get_filename_component(name "${file}" NAME)
    string(REGEX REPLACE "[^A-Za-z0-9]" "_" symbol "${name}")
    set(out "${out_dir}/embedded/${name}.h")
    file(RELATIVE_PATH path "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
    add_custom_command(
      OUTPUT "${out}"
      COMMAND ${CMAKE_COMMAND} -DIN=${CMAKE_CURRENT_SOURCE_DIR}/${file} -DOUT=${out} -DSYMBOL=${symbol} -DPATH_IN_SOURCES=${path}
              -P ${PROJECT_SOURCE_DIR}/cmake/embed_text_file.cmake
      DEPENDS "${file}" "${PROJECT_SOURCE_DIR}/cmake/embed_text_file.cmake"
      VERBATIM)
    target_sources(${target} PRIVATE "${out}")
  endforeach()
  target_include_directories(${target} PRIVATE "${out_dir}")
endfunction()
