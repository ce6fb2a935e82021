// Stages of the CPU path for SCREE_LANES bodies, pairs or contacts at once. The build compiles this file once per vector width
// (compute/CMakeLists.txt); compute/cpu/simd/simd_dispatch.cpp picks the widest that the processor has.
#include "compute/cpu/simd/simd_stages.h"

#include <stddef.h>

// Defines the types of the laws, so before them.
#include "compute/cpu/simd/simd_types.h"

#include "shaders/physics/base/contact_impulse.h"
#include "shaders/physics/body/motion.h"
#include "shaders/physics/body/periodic_cell.h"
#include "shaders/physics/collide/collide_box_box.h"
#include "shaders/physics/collide/collide_box_plane.h"
#include "shaders/physics/collide/collide_capsule_box.h"
#include "shaders/physics/collide/collide_capsule_capsule.h"
#include "shaders/physics/collide/collide_capsule_plane.h"
#include "shaders/physics/collide/collide_sphere_box.h"
#include "shaders/physics/collide/collide_sphere_capsule.h"
#include "shaders/physics/collide/collide_sphere_plane.h"
#include "shaders/physics/collide/collide_sphere_sphere.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/contact/cohesion.h"
#include "shaders/physics/contact/contact.h"
#include "shaders/physics/contact/contact_constraint.h"
#include "shaders/physics/contact/contact_pass.h"
#include "shaders/physics/contact/persistence.h"
#include "shaders/physics/continuous/clamping.h"
#undef float
#undef bool

#include "compute/cpu/simd/body_stages.h"
#include "compute/cpu/simd/cohesion_stage.h"
#include "compute/cpu/simd/contact_stages.h"
#include "compute/cpu/simd/pair_stages.h"

namespace scree::reference {

#define SCREE_STAGES(count) SCREE_JOINED(wide_stages_, count)
const WideStages SCREE_STAGES(SCREE_LANES) = {SCREE_LANES,
                                              SCREE_NAMED(SCREE_LANES)::bound,
                                              SCREE_NAMED(SCREE_LANES)::keep,
                                              SCREE_NAMED(SCREE_LANES)::collide,
                                              SCREE_NAMED(SCREE_LANES)::separate_boxes,
                                              SCREE_NAMED(SCREE_LANES)::collide_boxes,
                                              SCREE_NAMED(SCREE_LANES)::prepare,
                                              SCREE_NAMED(SCREE_LANES)::attract,
                                              SCREE_NAMED(SCREE_LANES)::begin,
                                              SCREE_NAMED(SCREE_LANES)::solve,
                                              SCREE_NAMED(SCREE_LANES)::move,
                                              SCREE_NAMED(SCREE_LANES)::relax,
                                              SCREE_NAMED(SCREE_LANES)::finish};

}  // namespace scree::reference
