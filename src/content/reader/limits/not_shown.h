// Features of a file that are not shown, for one warning.
#pragma once
#include <set>
#include <string>
#include <vector>

namespace lfdsim::reader {

/// The set of these features.
class NotShown {
  public:
    /// Adds a feature that is not shown, in the plural: "animations".
    void add(const std::string& what) { all_.insert(what); }

    /// Returns "animations and points are not shown"; empty if everything is shown.
    std::vector<std::string> notes() const {
        if (all_.empty()) return {};
        std::string text;
        std::size_t left = all_.size();
        for (const std::string& what : all_) {
            text += what;
            if (--left > 0) text += left == 1 ? " and " : ", ";
        }
        return {text + " are not shown"};
    }

  private:
    std::set<std::string> all_;
};

}  // namespace lfdsim::reader
