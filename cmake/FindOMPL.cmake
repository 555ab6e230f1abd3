# OMPL_INCLUDE_DIR and OMPL_LIBRARY of Debian's libompl-dev. OMPL's own CMake file wants all of Boost, which its headers here do not need.
find_path(OMPL_INCLUDE_DIR ompl/geometric/SimpleSetup.h PATH_SUFFIXES ompl-1.5 ompl-1.6 ompl-1.7 ompl)
find_library(OMPL_LIBRARY ompl)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OMPL REQUIRED_VARS OMPL_LIBRARY OMPL_INCLUDE_DIR)
