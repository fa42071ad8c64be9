find_package(Threads REQUIRED)
find_package(Vulkan REQUIRED COMPONENTS glslangValidator)
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(nanoflann REQUIRED)
find_package(CLI11 REQUIRED)
find_package(GTest REQUIRED)
find_package(assimp REQUIRED)
find_package(ZLIB REQUIRED)
find_package(glfw3 REQUIRED)
find_package(X11) # tests of the window alone; skipped without
find_package(PkgConfig REQUIRED)
pkg_check_modules(matio REQUIRED IMPORTED_TARGET matio)
pkg_check_modules(icu REQUIRED IMPORTED_TARGET icu-uc)
pkg_check_modules(webp REQUIRED IMPORTED_TARGET libwebpmux libwebp)
pkg_check_modules(webpdemux REQUIRED IMPORTED_TARGET libwebpdemux)

# Debian's export names a folder of OpenCV headers that its package does not depend on.
find_package(OpenImageIO REQUIRED)
get_target_property(_oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER _oiio_includes EXCLUDE REGEX "opencv")
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${_oiio_includes}")

# Debian's imgui.pc names its libraries in an order that does not link: a static library before what it needs.
find_library(NACRE_IMGUI_LIBRARY imgui REQUIRED)
find_library(NACRE_STB_LIBRARY stb REQUIRED)
find_path(NACRE_IMGUI_INCLUDE imgui.h PATH_SUFFIXES imgui REQUIRED)
add_library(imgui STATIC IMPORTED)
set_target_properties(imgui PROPERTIES
  IMPORTED_LOCATION "${NACRE_IMGUI_LIBRARY}"
  INTERFACE_INCLUDE_DIRECTORIES "${NACRE_IMGUI_INCLUDE}"
  INTERFACE_LINK_LIBRARIES "glfw;Vulkan::Vulkan;${NACRE_STB_LIBRARY}")
