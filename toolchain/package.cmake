# What is installed where, and the Debian package of the ceiling unit: `cpack` in a build folder writes
# dottrack_<version>_<architecture>.deb.
if(TARGET dottrackd)
  set(package_folder ${CMAKE_CURRENT_LIST_DIR}/package)
  install(TARGETS dottrackd COMPONENT unit)
  install(FILES ${package_folder}/dottrackd.service DESTINATION lib/systemd/system COMPONENT unit)
  install(FILES ${package_folder}/60-dottrack.rules DESTINATION lib/udev/rules.d COMPONENT unit)
  foreach(kind sysusers tmpfiles)
    install(FILES ${package_folder}/dottrack.${kind} DESTINATION lib/${kind}.d RENAME dottrack.conf
            COMPONENT unit)
  endforeach()
  install(FILES ${package_folder}/dottrack.modules DESTINATION lib/modules-load.d
          RENAME dottrack.conf COMPONENT unit)
  install(FILES ${package_folder}/rig.toml DESTINATION share/doc/dottrack/examples COMPONENT unit)

  # For whoever listens on the bus: the layout of the messages and the receiver to be copied.
  set(protocol_folder ${PROJECT_SOURCE_DIR}/app/core/protocol)
  install(FILES ${protocol_folder}/dottrack.dbc DESTINATION share/dottrack COMPONENT unit)
  install(FILES ${protocol_folder}/receiver/dottrack_receiver.h
                ${protocol_folder}/receiver/dottrack_receiver.c
          DESTINATION share/dottrack/receiver COMPONENT unit)
  install(FILES ${protocol_folder}/receiver/example/print_poses.c
                ${protocol_folder}/receiver/example/README.md
          DESTINATION share/dottrack/receiver/example COMPONENT unit)

  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME dottrack)
  set(CPACK_PACKAGE_CONTACT "The dottrack developers <dottrack@localhost>")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
  set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
      "dottrackd finds and follows dot targets on a vehicle with up to 16 ceiling cameras
and broadcasts the vehicle's pose on a CAN bus.")
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_COMPONENTS_ALL unit)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_DEBIAN_UNIT_PACKAGE_NAME dottrack)
  set(CPACK_DEBIAN_UNIT_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "libcamera-ipa, systemd, udev, kmod")
  set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
      "${package_folder}/postinst;${package_folder}/prerm;${package_folder}/postrm")
  # dpkg-shlibdeps looks where its environment says which architecture is meant.
  set(CPACK_PROJECT_CONFIG_FILE ${package_folder}/cpack_environment.cmake)
  include(CPack)
endif()
