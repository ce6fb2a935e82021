// Joints and vehicles of worlds. axis: 0 to 5, along x, y, z, then about; -1: along or about which each joint moves.
export function addJoints(World, library) {
  const indices = (room, joints) => {
    const list = typeof joints === 'number' ? [joints] : joints;
    return { at: room.numbers('i64', list), count: list.length };
  };
  const methods = {
    setDrives: 'set_drives', // stiffness, damping, target, target_speed, max_force
    setMotors: 'set_motors', // speed, max_force
    setJointCoordinates: 'set_joint_coordinates', // coordinate, rate
    applyJointForces: 'apply_joint_forces', // force
  };
  for (const [method, name] of Object.entries(methods))
    World.prototype[method] = function (joints, columns, axis = -1) {
      library.within((room) => {
        const of = indices(room, joints);
        const { at, count } = room.columns(columns, of.count);
        library.call(`world_${name}`, this.handle, of.at, of.count, axis, at, count);
      });
    };
  Object.assign(World.prototype, {
    joints() {
      return this.array('joints', (array) => array.records('scree_joint_state').map((state) => ({ ...state, broken: state.broken !== 0 })));
    },
    drives(axis = -1) {
      return library.within((room) => {
        const drives = room.array();
        library.call('world_drives', this.handle, axis, drives.at);
        return drives.records('scree_drive').map((drive) => ({ ...drive, locked: drive.locked !== 0 }));
      });
    },
    setSprings(joints, spring, axis = -1) {
      library.within((room) => {
        const of = indices(room, joints);
        library.call('world_set_springs', this.handle, of.at, of.count, axis, room.json(spring));
      });
    },
    // With bodies by index and anchors in their frames; or with anchor and axis in the world. Returns its index.
    addJoint(joint, anchor = undefined, axis = undefined) {
      return library.within((room) => {
        const index = room.word();
        library.call('world_add_joint', this.handle, room.json(joint), anchor ? room.vector(anchor, 'anchor') : 0,
          axis ? room.vector(axis, 'axis') : 0, index.at);
        return index.get();
      });
    },
    removeJoint(joint) {
      library.call('world_remove_joint', this.handle, joint);
    },
    vehicles() {
      return this.array('vehicles', (array) => array.records('scree_vehicle_state')
        .map((state) => ({ ...state, by_route: state.by_route !== 0, arrived: state.arrived !== 0 })));
    },
    drive(vehicle, { throttle = 0, brake = 0, steer = 0, handBrake = 0 } = {}) {
      library.call('world_drive', this.handle, vehicle, throttle, brake, steer, handBrake);
    },
    driveByRoute(vehicle) {
      library.call('world_drive_by_route', this.handle, vehicle);
    },
    resetUpright(vehicle) {
      library.call('world_reset_upright', this.handle, vehicle);
    },
  });
}
