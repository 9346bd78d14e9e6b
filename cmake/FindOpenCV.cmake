# OpenCV's few parts that we use. Debian ships OpenCV's own CMake files only in libopencv-dev, which
# pulls in several hundred packages (VTK, Qt, codecs); the parts' packages have headers and libraries.
find_path(OpenCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
set(required OpenCV_INCLUDE_DIR)
foreach(part ${OpenCV_FIND_COMPONENTS})
  find_library(OpenCV_${part}_LIBRARY opencv_${part})
  list(APPEND required OpenCV_${part}_LIBRARY)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCV REQUIRED_VARS ${required})
foreach(part ${OpenCV_FIND_COMPONENTS})
  if(NOT TARGET opencv_${part})
    add_library(opencv_${part} UNKNOWN IMPORTED)
    set_target_properties(opencv_${part} PROPERTIES IMPORTED_LOCATION ${OpenCV_${part}_LIBRARY}
                                                    INTERFACE_INCLUDE_DIRECTORIES ${OpenCV_INCLUDE_DIR}
                                                    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${OpenCV_INCLUDE_DIR})
  endif()
endforeach()
