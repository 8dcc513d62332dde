dottrack_test(host_sim_uvc_test
  SOURCES scene_cameras_test.cpp uvc_device_test.cpp uvc_frame_test.cpp
  USES dottrack::host_sim_usb_cameras)
dottrack_test(host_sim_usb_camera_bank_test
  SOURCES redir_guest.cpp usb_camera_bank_test.cpp
  USES dottrack::host_sim_usb_cameras dottrack::test_support LABELS threads)
