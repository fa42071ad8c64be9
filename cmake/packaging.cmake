# What `cmake --install` and a Debian package hold: the program, its completion and its manual page, which it prints itself.
set(NACRE_TEXTS "${CMAKE_CURRENT_BINARY_DIR}/texts")
file(MAKE_DIRECTORY "${NACRE_TEXTS}")
add_custom_command(OUTPUT "${NACRE_TEXTS}/nacre" "${NACRE_TEXTS}/nacre.1"
  COMMAND nacre --bash-completion > "${NACRE_TEXTS}/nacre"
  COMMAND nacre --man-page > "${NACRE_TEXTS}/nacre.1"
  DEPENDS nacre
  COMMENT "Printing the completion and the manual page"
  VERBATIM)
add_custom_target(nacre_texts ALL DEPENDS "${NACRE_TEXTS}/nacre" "${NACRE_TEXTS}/nacre.1")

install(FILES "${NACRE_TEXTS}/nacre" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
install(FILES "${NACRE_TEXTS}/nacre.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME nacre)
set(CPACK_PACKAGE_CONTACT "The Nacre authors <nacre@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Measures materials from photographs under a moving light and relights them")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The fonts are opened by name, gnuplot is started; the driver is one that draws without a GPU.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "mesa-vulkan-drivers, gnuplot-nox")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
include(CPack)
