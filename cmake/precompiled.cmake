include(${CMAKE_CURRENT_LIST_DIR}/unity.cmake)

# precompile(target [header...]): parses once, for all of a target's sources, what most of them include, and compiles
# them folder by folder.
function(precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span> <string> <vector>
    <fmt/format.h> <glm/common.hpp> <glm/geometric.hpp> <glm/trigonometric.hpp> <glm/vec2.hpp> <glm/vec3.hpp> ${ARGN})
  unity_by_folder(${target})
endfunction()
