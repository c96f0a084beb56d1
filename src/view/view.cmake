# `lfdsim view`: its server, its pictures and answers. Only headers of Boost are used: Asio and Beast.
find_package(Boost 1.74 REQUIRED GLOBAL)  # the tests use it too

lfdsim_library(view
  LINK PUBLIC lfdsim_report lfdsim_files nlohmann_json::nlohmann_json
    PRIVATE Boost::headers Threads::Threads PNG::PNG JPEG::JPEG TBB::tbb fmt::fmt)
lfdsim_precompile(lfdsim_view <fmt/format.h> <nlohmann/json.hpp>)
