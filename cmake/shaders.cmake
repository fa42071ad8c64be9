# add_shaders(target file...): compiles GLSL to SPIR-V and embeds each as a C array in a generated header
# <name>_<stage>.h, e.g. direct.frag -> direct_frag.h with `const uint32_t direct_frag[]`.
function(add_shaders target)
  set(out_dir "${CMAKE_CURRENT_BINARY_DIR}/spirv")
  file(MAKE_DIRECTORY "${out_dir}")
  set(headers)
  foreach(source IN LISTS ARGN)
    get_filename_component(path "${source}" ABSOLUTE)
    get_filename_component(name "${source}" NAME)
    string(REPLACE "." "_" symbol "${name}")
    set(header "${out_dir}/${symbol}.h")
    add_custom_command(
      OUTPUT "${header}"
      COMMAND Vulkan::glslangValidator --quiet --target-env vulkan1.3 -I${PROJECT_SOURCE_DIR}/shaders
              --vn ${symbol} --depfile "${header}.d" -o "${header}" "${path}"
      DEPENDS "${path}"
      DEPFILE "${header}.d"
      COMMENT "Compiling shader ${name}"
      VERBATIM)
    list(APPEND headers "${header}")
  endforeach()
  add_custom_target(${target}_shaders DEPENDS ${headers})
  target_sources(${target} PRIVATE ${headers})
  target_include_directories(${target} PRIVATE "${out_dir}")
endfunction()
