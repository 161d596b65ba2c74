# Install rules and the package: find_package(Peperite CONFIG) gives Peperite::fp, ::decomp and ::sph. The
# programs install themselves in apps/.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Peperite)

install(TARGETS peperite_fp decomp stokes sph EXPORT Peperite FILE_SET HEADERS)
if(PEPERITE_METIS)
  install(TARGETS metis_partition EXPORT Peperite FILE_SET HEADERS)
endif()
install(EXPORT Peperite NAMESPACE Peperite:: DESTINATION ${package_dir} FILE PeperiteTargets.cmake)
configure_package_config_file(cmake/PeperiteConfig.cmake.in PeperiteConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(PeperiteConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PeperiteConfig.cmake ${PROJECT_BINARY_DIR}/PeperiteConfigVersion.cmake
  DESTINATION ${package_dir})
