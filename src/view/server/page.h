// The page that `lfdsim view` serves: one HTML text that loads nothing else. Floor 5.
#pragma once
#include <string>

namespace lfdsim::view {

/// Returns the page in UTF-8. It has one element <style> and one <script type="module">, both without further attributes, and no
/// markup with style or event attributes: a Content-Security-Policy can allow just these two by hash or nonce.
std::string page();

}  // namespace lfdsim::view
