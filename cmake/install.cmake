# What `cmake --install` puts where, the files by which others find it, and the Debian package.
#
# The layout is fixed, bin lib include share under one prefix: the program finds its modules, its
# configuration and its scaffold beside itself, so the installed tree can be moved as a whole.
include(CMakePackageConfigHelpers)

install(TARGETS cairn RUNTIME DESTINATION bin)
install(TARGETS cairn_maps cairn_framework EXPORT cairn LIBRARY DESTINATION lib)
install(TARGETS cairn_pictures cairn_experiments LIBRARY DESTINATION lib NAMELINK_SKIP)  # the program's alone

# What must have been built.
get_property(modules GLOBAL PROPERTY CAIRN_MODULES)
list(TRANSFORM modules REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE files)
foreach(target cairn cairn_maps cairn_framework cairn_pictures cairn_experiments)
  list(APPEND files $<TARGET_FILE:${target}>)
endforeach()
list(JOIN files "\n" files)
file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/to_install.txt CONTENT "${files}\n")

# Headers keep the paths that sources include them by. The saved map's inner headers stay home.
install(DIRECTORY maps DESTINATION include/cairn FILES_MATCHING PATTERN *.hpp
        PATTERN pictures EXCLUDE PATTERN store EXCLUDE)
install(FILES maps/store/map_store.hpp maps/store/map_updater.hpp maps/store/repair.hpp DESTINATION include/cairn/maps/store)
install(DIRECTORY framework DESTINATION include/cairn FILES_MATCHING PATTERN *.hpp
        PATTERN experiments EXCLUDE PATTERN program EXCLUDE PATTERN scaffold EXCLUDE)
install(DIRECTORY config framework/scaffold DESTINATION share/cairn)
# The build tree has the same shape.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share/cairn)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/config ${CMAKE_BINARY_DIR}/share/cairn/config SYMBOLIC)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/framework/scaffold ${CMAKE_BINARY_DIR}/share/cairn/scaffold SYMBOLIC)

set(package_folder lib/cmake/cairn)
install(EXPORT cairn NAMESPACE cairn:: FILE cairnTargets.cmake DESTINATION ${package_folder})
configure_package_config_file(cmake/cairnConfig.cmake.in ${CMAKE_BINARY_DIR}/cairnConfig.cmake
                              INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/cairnConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/cairnConfig.cmake ${CMAKE_BINARY_DIR}/cairnConfigVersion.cmake
              cmake/cairn_add_module.cmake DESTINATION ${package_folder})
install(FILES cmake/exports/module.map DESTINATION ${package_folder}/exports)
configure_file(cmake/cairn.pc.in ${CMAKE_BINARY_DIR}/cairn.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/cairn.pc DESTINATION lib/pkgconfig)

# The suites are a test target: installed when they have been built, found as a component.
if(TARGET cairn_conformance)
  set_target_properties(cairn_conformance PROPERTIES EXPORT_NAME conformance)
  target_include_directories(cairn_conformance INTERFACE $<INSTALL_INTERFACE:include/cairn>)
  install(TARGETS cairn_conformance EXPORT cairn_conformance ARCHIVE DESTINATION lib OPTIONAL)
  install(EXPORT cairn_conformance NAMESPACE cairn:: FILE cairnConformanceTargets.cmake DESTINATION ${package_folder})
  install(DIRECTORY tests/conformance DESTINATION include/cairn/tests FILES_MATCHING PATTERN *.hpp
          PATTERN shipped EXCLUDE PATTERN faulty EXCLUDE)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Cairn authors <cairn@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, python3-numpy")  # charts; modules in Python
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, g++, libeigen3-dev, libgtest-dev")  # to write modules
if(TARGET cairn_python)  # a package of its own
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_COMPONENTS_ALL Unspecified python3)
  set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME cairn)
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_NAME python3-cairn)
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_DEPENDS "cairn (= ${PROJECT_VERSION}), ${CAIRN_PYTHON_DEPENDS}")
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_RECOMMENDS "")
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_SUGGESTS "python3-matplotlib, ipython3")
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib)
endif()
include(CPack)
