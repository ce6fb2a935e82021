// The records of a step, laid out alike on the CPU and by std430.
//
// Their words are state: they are hashed, saved and compared between processors. So what fills a record up is a member too
// (pad0), and is written: a shader that stores a record leaves the gaps between its members as they were.
#ifndef SCREE_PHYSICS_RECORDS_H
#define SCREE_PHYSICS_RECORDS_H

#include "shaders/physics/base/body_records.h"
#include "shaders/physics/base/bond_records.h"
#include "shaders/physics/base/contact_records.h"
#include "shaders/physics/base/joint_records.h"
#include "shaders/physics/base/step_records.h"
#include "shaders/physics/base/vehicle_records.h"

#endif
