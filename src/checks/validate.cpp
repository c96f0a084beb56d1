// The order of the checks of a description.

#include "checks/findings.h"
#include "geometry/geometry.h"

namespace lfdsim {

std::vector<Problem> validate(const Display& d) {
    std::vector<Problem> problems;
    Findings findings(problems);
    validate_all(d, findings, true);
    return problems;
}

void validate_all(const Display& d, Findings& findings, bool glasses_known) {
    validate_values(d, findings);
    validate_panel(d, findings);
    validate_content(d, findings);
    if (!glasses_known) return;
    validate_glass(d, findings);
    validate_lens(d, findings);
    validate_layout(d, findings);
    validate_errors(d, findings);
}

}  // namespace lfdsim
