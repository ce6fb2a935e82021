// The commit of the program.
#include "demos/program/commit.h"

#include "demos/program/outputs/report.h"

namespace scree::demos {

std::string program_commit() {
    return SCREE_COMMIT;
}

}  // namespace scree::demos
