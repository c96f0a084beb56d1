// The page that `lfdsim view` serves: one HTML text that asks for nothing else. Floor 5.
#pragma once
#include <string>

namespace lfdsim::view {

/// UTF-8. It has one element <style> and one <script type="module">, both without further attributes, and no markup with style or
/// event attributes: a Content-Security-Policy may let in just these two by hash or by nonce.
std::string page();

}  // namespace lfdsim::view
