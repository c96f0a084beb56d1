#include "model/findings.h"
#include "model/geometry.h"

namespace lfdsim {

std::vector<Problem> validate(const Display& d) {
    std::vector<Problem> problems;
    Findings findings(problems);
    validate_values(d, findings);
    validate_panel(d, findings);
    validate_glass(d, findings);
    validate_lens(d, findings);
    validate_content(d, findings);
    validate_layout(d, findings);
    validate_errors(d, findings);
    return problems;
}

}  // namespace lfdsim
