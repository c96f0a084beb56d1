# The libraries that lfdsim's depend on; where lfdsim is installed, its package configuration reads this too.
include(CMakeFindDependencyMacro)

# Debian's Imath, under OpenEXR, says at length that a Python library is absent, which nothing here uses.
set(CMAKE_MESSAGE_LOG_LEVEL NOTICE)
find_dependency(OpenEXR REQUIRED)
unset(CMAKE_MESSAGE_LOG_LEVEL)

find_dependency(Threads REQUIRED)
find_dependency(TBB REQUIRED)
find_dependency(PNG REQUIRED)
find_dependency(JPEG REQUIRED)
find_dependency(tomlplusplus REQUIRED)
find_dependency(fmt REQUIRED)
find_dependency(embree 3 REQUIRED)
find_dependency(nlohmann_json REQUIRED)
