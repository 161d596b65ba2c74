# Install rules and the package: find_package(Peperite CONFIG) gives Peperite::fp, ::decomp and ::sph. The
# programs, their scenes and the package of Python install themselves in apps/. `cpack --config build/CPackConfig.cmake` makes
# a package of Debian; for other machines than this one configure with -DPEPERITE_ARCH=x86-64-v3.
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
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE apps/keys.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES apps/scene.schema.json benchmarks/slurm/peperite.sbatch DESTINATION ${CMAKE_INSTALL_DATADIR}/peperite)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME peperite)
set(CPACK_PACKAGE_CONTACT "the authors of Peperite")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Particle simulations with the same bits on any number of ranks")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
  "python3, python3-h5py, python3-jinja2, python3-matplotlib, python3-mpi4py, python3-numpy, python3-pil, libjs-dygraphs")
include(CPack)
