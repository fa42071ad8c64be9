# embed_texts(target header file...): a generated header with the content of each file under its name from the root of
# the sources, as `inline constexpr std::pair<std::string_view, std::string_view> kEmbeddedTexts[]`.
set(NACRE_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

function(embed_texts target header)
  set(out_dir "${CMAKE_CURRENT_BINARY_DIR}/embedded")
  list(TRANSFORM ARGN PREPEND "${PROJECT_SOURCE_DIR}/" OUTPUT_VARIABLE files)
  string(REPLACE ";" "," names "${ARGN}")
  add_custom_command(
    OUTPUT "${out_dir}/${header}"
    COMMAND "${CMAKE_COMMAND}" -D "ROOT=${PROJECT_SOURCE_DIR}" -D "NAMES=${names}" -D "OUTPUT=${out_dir}/${header}"
            -P "${NACRE_EMBED_SCRIPT}"
    DEPENDS ${files} "${NACRE_EMBED_SCRIPT}"
    COMMENT "Embedding ${header}"
    VERBATIM)
  add_custom_target(${target}_texts DEPENDS "${out_dir}/${header}")
  target_sources(${target} PRIVATE "${out_dir}/${header}")
  target_include_directories(${target} PRIVATE "${out_dir}")
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  set(text "#pragma once\n#include <string_view>\n#include <utility>\n\ninline constexpr std::pair<std::string_view, std::string_view> kEmbeddedTexts[] = {\n")
  string(REPLACE "," ";" names "${NAMES}")
  foreach(name IN LISTS names)
    file(READ "${ROOT}/${name}" content)
    string(APPEND text "{\"${name}\", R\"nacre(${content})nacre\"},\n")
  endforeach()
  file(WRITE "${OUTPUT}" "${text}};\n")
endif()
