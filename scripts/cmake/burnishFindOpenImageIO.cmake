# Finds OpenImageIO. Debian's exported target names include folders of packages it does not depend on (OpenCV's), which CMake
# refuses where they are not installed: those that do not exist are taken out.
find_package(OpenImageIO REQUIRED)
get_target_property(_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
set(_existing "")
foreach(_dir IN LISTS _includes)
  if(EXISTS "${_dir}")
    list(APPEND _existing "${_dir}")
  endif()
endforeach()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${_existing}")
string(REGEX MATCH "^[0-9]+\\.[0-9]+\\.[0-9]+" BURNISH_OPENIMAGEIO_VERSION "${OpenImageIO_VERSION}")
