/* scree for C, and for every language that calls C: scenes, worlds, queries, pictures.
 *
 *     scree_scene* scene;
 *     scree_world* world;
 *     if (scree_scene_demo("wall", 0, 1, &scene) || scree_world_create(scene, NULL, &world) ||
 *         scree_world_step(world, 60, NULL, NULL))
 *         fprintf(stderr, "%s\n", scree_error_message());
 *
 * Every call that can fail returns a scree_result: 0, or the kind of the error, which scree_error_message() tells in words. A
 * call that is refused changes nothing. No exception leaves the library.
 *
 * Handles (scree_scene* and the like) are numbers, not addresses. One that is null, released or of another kind is refused.
 *
 * Texts and arrays that a call gives stay until the same thread makes its next call, those that release and scree_error_...()
 * left out: copy what you keep. Texts are UTF-8. Units are SI: m, kg, s, N, rad. Quaternions are x, y, z, w.
 * Bodies, joints and vehicles are numbered from 0 in the order in which they were added; removing a joint shifts those behind it,
 * and the index of a removed body is given to a new one. A text or array that a call takes is its caller's again when it returns.
 *
 * Structs that begin with `size` may grow: set it by SCREE_INIT, as in scree_world_options options =
 * SCREE_INIT(scree_world_options). Records in arrays may grow at their end: go from one to the next by the stride, which calls
 * take and give.
 *
 * Threads may use different worlds and scenes at once. A call does not wait for another one in the same world, or around it
 * (progress): it is refused (SCREE_BUSY). Scenes may be read by several.
 *
 * The same bits on every processor and device, as of scree's other languages. Descriptions in JSON have the keys of scene files:
 * scree_describe("schema", NULL, &text) gives their JSON schema. */
#ifndef SCREE_H
#define SCREE_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(SCREE_BUILD)
#define SCREE_API __declspec(dllexport)
#elif defined(_WIN32)
#define SCREE_API __declspec(dllimport)
#elif defined(__GNUC__)
#define SCREE_API __attribute__((visibility("default")))
#else
#define SCREE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Results */

typedef enum scree_result {
    SCREE_OK = 0,
    SCREE_BAD_ARGUMENT = 1,   /* null, a number out of range, an unknown word, a text that is not UTF-8 */
    SCREE_BAD_HANDLE = 2,     /* null, released, or of another kind */
    SCREE_BAD_INDEX = 3,      /* no such body, joint, vehicle, copy or grip; a body's handle whose body is gone */
    SCREE_BAD_SCENE = 4,      /* a description: scree_error_place() is its JSON pointer, such as /bodies/3/shape */
    SCREE_BAD_CHECKPOINT = 5, /* a saved state: damaged, or of another scene or version */
    SCREE_FILE_ERROR = 6,     /* cannot be read or written, or is damaged */
    SCREE_DEVICE_ERROR = 7,   /* of a graphics device or its driver */
    SCREE_NO_MEMORY = 8,
    SCREE_BUSY = 9,        /* another call is in it, on another thread or around this one */
    SCREE_STOPPED = 10,    /* by the progress callback */
    SCREE_IMPOSSIBLE = 11, /* not in this state: the message says why */
    SCREE_VIEWED = 12      /* views look into the tables that it would move */
} scree_result;

/* Of the last call of this thread that failed. */
SCREE_API const char* scree_error_message(void);
SCREE_API const char* scree_error_place(void); /* a JSON pointer, or "" */

SCREE_API const char* scree_version(void); /* such as "0.16.0" */
SCREE_API int scree_has_vulkan(void);      /* whether it was built with it */

/* JSON of what the library knows. what: "schema" of scene files; "settings" by default; "demos", an array of [name, line]; "keys"
 * of an object of scene files, which `name` names: body, joint, settings, vehicle, filter, material, fields, fracture, tyre,
 * controls, picture, camera. Else name may be null. */
SCREE_API scree_result scree_describe(const char* what, const char* name, const char** json);

/* Devices that were opened for worlds stay open for the next ones. Closes those that no world uses. */
SCREE_API void scree_close_devices(void);

/* ---- Memory of the caller and of the library */

#ifdef __cplusplus
#define SCREE_INIT(type)                     \
    [] {                                     \
        type scree_made{};                   \
        scree_made.size = sizeof scree_made; \
        return scree_made;                   \
    }()
#else
#define SCREE_INIT(type) \
    { .size = sizeof(type) }
#endif

/* Rows of floats of the caller, by the name of what they are. */
typedef struct scree_column {
    const char* name;
    const float* data;
    size_t stride; /* bytes from row to row; 0: rows follow each other */
} scree_column;

/* Memory of the caller to be written. */
typedef struct scree_output {
    const char* name;
    void* data;
    size_t stride; /* likewise */
} scree_output;

/* Memory of the library. */
typedef struct scree_array {
    const void* data;
    size_t count;  /* records */
    size_t stride; /* bytes from record to record */
} scree_array;

/* ---- Scenes: descriptions of bodies, joints, vehicles, and how they are run and shown */

typedef struct scree_scene scree_scene;

SCREE_API scree_result scree_scene_create(scree_scene** scene); /* empty */
SCREE_API scree_result scree_scene_copy(const scree_scene* scene, scree_scene** copy);
SCREE_API void scree_scene_release(scree_scene* scene); /* null is allowed */

SCREE_API scree_result scree_scene_from_json(const char* json, scree_scene** scene);

typedef struct scree_load_options {
    size_t size;
    int strict;                /* 1: what an import would note is an error */
    int file_axes;             /* 1: keep the file's axes; 0: y up */
    int ground;                /* 1: with a plane below the lowest point */
    int allow_outside;         /* 1: meshes may lie outside of the file's folder */
    const char* base;          /* of a URDF: "fixed", "free" or null: as the file says */
    const char* keyframe;      /* of a MJCF file, or null */
    const char* packages_json; /* an object of folders by package name, or null */
} scree_load_options;
/* A scene file (.json), MJCF, URDF, glTF, STL or OBJ. options may be null. */
SCREE_API scree_result scree_scene_load(const char* path, const scree_load_options* options, scree_scene** scene);
SCREE_API scree_result scree_is_import(const char* path, int* is_import); /* by its ending */

/* A demo; bodies: about how many, 0: as many as it has. */
SCREE_API scree_result scree_scene_demo(const char* name, size_t bodies, uint64_t seed, scree_scene** scene);

/* Adds `count` bodies that are alike but for the columns, which have a row for each and the name of a key of bodies: of a number,
 * or of a vector of three or four. first: index of the first. */
SCREE_API scree_result scree_scene_add_bodies(scree_scene* scene, const char* body_json, size_t count,
                                              const scree_column* columns, size_t column_count, size_t* first);
/* list: "joints", "vehicles", "events", "exclusions" ([a, b]), "grains", "bonds", "servo_walls", or the presets "cars" and
 * "carts". index: in the list, of grains that of the first body, or of the event that pours them, of bonds the first, of a servo
 * wall that of its joint; may be null. */
SCREE_API scree_result scree_scene_add(scree_scene* scene, const char* list, const char* json, size_t* index);
/* key: "settings", "picture", "camera", "fields", "periodic", "gravity", "duration". null as JSON takes settings, picture and
 * camera away. */
SCREE_API scree_result scree_scene_set(scree_scene* scene, const char* key, const char* json);
/* key: those of scree_scene_set; "notes" of reading it; names of "bodies", "joints", "vehicles"; "scene": all of it, as a scene
 * file; "whole": with the meshes of files in it. */
SCREE_API scree_result scree_scene_get(const scree_scene* scene, const char* key, const char** json);
SCREE_API scree_result scree_scene_count(const scree_scene* scene, const char* list,
                                         size_t* count); /* bodies, joints, vehicles, events */
/* The first two of that name, as uint64_t: none, one, or an ambiguous name. */
SCREE_API scree_result scree_scene_find(const scree_scene* scene, const char* list, const char* name, scree_array* indices);
SCREE_API scree_result scree_scene_body_name(const scree_scene* scene, size_t body, const char** name);
/* Its chassis, then its wheels, as uint64_t. */
SCREE_API scree_result scree_scene_vehicle_bodies(const scree_scene* scene, size_t vehicle, scree_array* bodies);
/* SCREE_BAD_SCENE if it cannot be simulated; notes: a JSON array of what is changed before. */
SCREE_API scree_result scree_scene_check(const scree_scene* scene, const char** notes_json);
SCREE_API scree_result scree_scene_hash(const scree_scene* scene, uint64_t* hash);
SCREE_API scree_result scree_scene_save(const scree_scene* scene, const char* path); /* as a scene file, or not at all */
/* Of a body in JSON; density: kg/m^3. inertia: principal moments about its axes, kg m^2. */
SCREE_API scree_result scree_mass_properties(const char* body_json, float density, float* mass, float inertia[3]);

/* ---- Worlds */

typedef struct scree_world scree_world;

typedef struct scree_world_options {
    size_t size;
    const char* backend;       /* "auto" (or null: the fastest), "cpu", "vulkan" */
    const char* device;        /* of Vulkan: part of its name, or its number; null: the first */
    const char* settings_json; /* over those of the scene; null: none */
    int threads;               /* of the CPU; 0: all */
    int validate;              /* 1: with Vulkan's validation layers */
    size_t copies;             /* of the scene, which do not meet; 0: the scene itself */
} scree_world_options;

/* The world keeps no tie to the scene. options may be null. */
SCREE_API scree_result scree_world_create(const scree_scene* scene, const scree_world_options* options, scree_world** world);
/* One copy of each scene. All have the same bodies and joints in the same order, which may differ in poses, velocities, masses,
 * materials and the like, and in gravity. Settings are those of the first. */
SCREE_API scree_result scree_world_create_copies(const scree_scene* const* scenes, size_t count,
                                                 const scree_world_options* options, scree_world** world);
/* Ends its exports. A call that is in the world goes on, and the world ends with it; so it does with the last of its views. null
 * is allowed. */
SCREE_API void scree_world_release(scree_world* world);

/* done and count: steps. Returns 0 to go on. What it asks of the world is refused. */
typedef int (*scree_progress)(void* user, uint64_t done, uint64_t count);
/* Steps of 1 / rate s: 60 a second, or as the settings say. Performs the scene's timed events on the way. progress is called
 * between steps, at least once in 20 ms or step; it and user may be null. */
SCREE_API scree_result scree_world_step(scree_world* world, uint64_t count, scree_progress progress, void* user);
/* Later steps perform what the program does in a run of this demo and is no part of its scene: bodies of "fountain" are born and
 * go. bodies and seed: as of scree_scene_demo. name: null: nothing any more. Such a world can have no views while it steps. */
SCREE_API scree_result scree_world_follow_demo(scree_world* world, const char* name, size_t bodies, uint64_t seed);

typedef struct scree_world_info {
    size_t size;
    uint64_t steps;      /* done */
    double time;         /* s */
    size_t bodies;       /* indices that are or were in use, over all copies */
    size_t bodies_there; /* that exist */
    size_t joints;
    size_t copies;
    size_t buffer_bytes, buffer_growths;
    int records_events;
    const char *backend, *device, *remark; /* "cpu" or "vulkan"; its name; why another than asked for was taken, or "" */
} scree_world_info;
SCREE_API scree_result scree_world_get_info(scree_world* world, scree_world_info* info);
/* list: "bodies", "bodies_there", "joints", "vehicles", "copies", as in scree_world_info. */
SCREE_API scree_result scree_world_count(scree_world* world, const char* list, size_t* count);
/* key: "settings"; "stage_times": milliseconds of the last step by stage, while "profiling" is set; names of "bodies" or "joints"
 * of one copy. */
SCREE_API scree_result scree_world_get(scree_world* world, const char* key, const char** json);
SCREE_API scree_result scree_world_find(scree_world* world, const char* list, const char* name,
                                        scree_array* indices); /* in one copy */

#define SCREE_ALL_COPIES ((size_t)-1)

typedef struct scree_statistics {
    size_t size;
    uint64_t bodies, broken, pieces, manifolds, points;
    double penetration_mean, penetration_max, penetration_resting; /* m */
    double max_speed, max_spin;                                    /* m/s, rad/s */
    uint64_t spin_limited;
    double kinetic_energy, potential_energy; /* J */
    double momentum[3], angular_momentum[3]; /* kg m/s, kg m^2/s */
    double drift_max;                        /* m, of what was at rest at first */
    uint64_t asleep, not_finite, below_ground, joints, joints_broken;
    double joint_force_max, joint_torque_max; /* N, N m */
} scree_statistics;
SCREE_API scree_result scree_world_statistics(scree_world* world, size_t copy, scree_statistics* statistics);

/* Of the state: equal exactly where positions, orientations and velocities are, bit for bit. */
SCREE_API scree_result scree_world_hash(scree_world* world, uint64_t* hash);
SCREE_API scree_result scree_world_copy_hashes(scree_world* world, scree_array* hashes); /* uint64_t of each copy */

/* ---- Saving and going back */

SCREE_API scree_result scree_world_save(scree_world* world, scree_array* bytes);
SCREE_API scree_result scree_world_restore(scree_world* world, const void* bytes, size_t count);
SCREE_API scree_result scree_world_write_checkpoint(scree_world* world, const char* path, const char* note);
SCREE_API scree_result scree_world_read_checkpoint(scree_world* world, const char* path, const char** note);
SCREE_API scree_result scree_world_keep_state(scree_world* world);
SCREE_API scree_result scree_world_roll_back(scree_world* world, uint64_t steps);       /* back, to a kept state */
SCREE_API scree_result scree_world_kept_states(scree_world* world, scree_array* steps); /* uint64_t */
SCREE_API scree_result scree_world_drop_states(scree_world* world);
/* The scene as it is now; in a world of several copies that of one. */
SCREE_API scree_result scree_world_snapshot(scree_world* world, size_t copy, scree_scene** scene);

/* ---- Copies */

SCREE_API scree_result scree_world_reset(scree_world* world, const uint8_t* copies,
                                         size_t count); /* those that are not 0, to the start */
SCREE_API scree_result scree_world_gravity(scree_world* world, size_t copy, float gravity[3]);
SCREE_API scree_result scree_world_set_gravity(scree_world* world, size_t copy, const float gravity[3]);
/* Of the periodic cell now: m, 0 along axes without; 1/s. */
SCREE_API scree_result scree_world_cell(scree_world* world, float size[3], float rate[3]);
SCREE_API scree_result scree_world_wake_copy(scree_world* world, size_t copy); /* SCREE_ALL_COPIES: everything */

/* ---- Bodies */

/* Names one body for its whole life; an index is given to a new body once its body was removed. */
typedef struct scree_body {
    uint32_t index, generation;
} scree_body;

/* Writes columns of all bodies: position (3 floats), orientation (4), velocity (3), angular_velocity (3), mass (1), asleep (1
 * byte), exists (1 byte). count: rows that the memory has, at least as many as bodies. */
SCREE_API scree_result scree_world_read(scree_world* world, const scree_output* outputs, size_t output_count, size_t count);
/* Of some: position, orientation, velocity, angular_velocity; position and orientation of their authored frames
 * ("origin_position", "origin_orientation"); force by which they are touched ("touch_force", 3). */
SCREE_API scree_result scree_world_read_of(scree_world* world, const int64_t* bodies, size_t count, const scree_output* outputs,
                                           size_t output_count);
/* Sets position, orientation, velocity and angular_velocity of some; what is left out stays. Positions lie within 1e6 m of 0. */
SCREE_API scree_result scree_world_write(scree_world* world, const int64_t* bodies, size_t count, const scree_column* columns,
                                         size_t column_count);
/* Acts on dynamic ones: force and torque during the next step, impulse and angular_impulse at once; offset: of the point on which
 * force and impulse act, from the centre of mass, m, world axes. */
SCREE_API scree_result scree_world_apply(scree_world* world, const int64_t* bodies, size_t count, const scree_column* columns,
                                         size_t column_count);
/* Moves kinematic ones to position and orientation, both needed, within so many steps, 1 to 1e6. */
SCREE_API scree_result scree_world_move(scree_world* world, const int64_t* bodies, size_t count, const scree_column* columns,
                                        size_t column_count, int steps);
/* The bodies of a scene, without its joints, added while the world runs: scree_body of each. */
SCREE_API scree_result scree_world_add_bodies(scree_world* world, const scree_scene* scene, scree_array* bodies);
SCREE_API scree_result scree_world_remove_bodies(scree_world* world, const scree_body* bodies, size_t count);
SCREE_API scree_result scree_world_bodies(scree_world* world, const int64_t* indices, size_t count, scree_body* bodies);
SCREE_API scree_result scree_world_are_valid(scree_world* world, const scree_body* bodies, size_t count, uint8_t* valid);
SCREE_API scree_result scree_world_wake(scree_world* world, const int64_t* bodies, size_t count);
/* The fields of a material that the JSON names; the others stay. */
SCREE_API scree_result scree_world_set_material(scree_world* world, const int64_t* bodies, size_t count,
                                                const char* material_json);
/* what: "mass" (kg), "filter", "motion" ("fixed", "kinematic" or "dynamic"), as in scene files. */
SCREE_API scree_result scree_world_set_body(scree_world* world, size_t body, const char* what, const char* json);
SCREE_API scree_result scree_world_set_exclusion(scree_world* world, size_t a, size_t b, int excluded);
/* what: "fields" (of wind, fluids, attractors), "friction_factor", "least_restitution", "substeps", "cell_rate" (of the periodic
 * cell, 1/s), "sleeping", "profiling". */
SCREE_API scree_result scree_world_set(scree_world* world, const char* what, const char* json);
SCREE_API scree_result scree_world_explode(scree_world* world, const float centre[3], float radius, float speed);

/* A spring that holds a point of a body: anchor in its frame, target in the world. Four at a time. */
typedef struct scree_grip_options {
    size_t size;
    float hertz, damping_ratio, max_acceleration, spin_damping; /* 0: as by default */
} scree_grip_options;
SCREE_API scree_result scree_world_grip(scree_world* world, size_t body, const float anchor[3], const float target[3],
                                        const scree_grip_options* options, size_t* grip);
SCREE_API scree_result scree_world_move_grip(scree_world* world, size_t grip, const float target[3]);
SCREE_API scree_result scree_world_release_grip(scree_world* world, size_t grip);

/* The tables of the CPU, without a copy; the rows stay until the view is released, also when the world was. While a view is held,
 * what would move them is refused: adding and removing bodies, restoring, rolling back. Rows are bodies in an order of the
 * world's own: "ids" gives the body of each. A step changes what they hold. name: "poses" (position at 0, orientation at 16
 * bytes), "velocities" (linear at 0, angular at 16), "ids" (uint32_t). */
typedef struct scree_view scree_view;
SCREE_API scree_result scree_world_view(scree_world* world, const char* name, scree_view** view, scree_array* rows);
SCREE_API void scree_view_release(scree_view* view);
SCREE_API scree_result scree_world_view_count(scree_world* world, size_t* views);
SCREE_API scree_result scree_world_row_of(scree_world* world, size_t body, size_t* row);

/* ---- Contacts and events */

typedef struct scree_contact {
    int64_t a, b;
    int32_t part_a, part_b; /* of compounds the part, of meshes and height fields the triangle */
    float normal[3];        /* from a to b */
    float friction[3];      /* on b, N, in the last substep */
    int32_t count;          /* points, 1 to 4 */
    float position[4][3];   /* m */
    float separation[4];    /* m, below 0: overlap */
    float force[4];         /* normal force, N, in the last substep */
} scree_contact;
SCREE_API scree_result scree_world_contacts(scree_world* world, scree_array* contacts); /* of the last step */

typedef enum scree_event_kind {
    SCREE_EVENT_BEGIN = 0,
    SCREE_EVENT_END = 1,
    SCREE_EVENT_HIT = 2,
    SCREE_EVENT_BODY_BROKE = 3,
    SCREE_EVENT_JOINT_BROKE = 4,
    SCREE_EVENT_FELL_ASLEEP = 5,
    SCREE_EVENT_WOKE = 6,
    SCREE_EVENT_SENSOR_BEGIN = 7,
    SCREE_EVENT_SENSOR_END = 8
} scree_event_kind;
typedef struct scree_event {
    int64_t step;                             /* steps done after the one in which it happened */
    int64_t a, a_generation, b, b_generation; /* bodies; -1: the world */
    int32_t part_a, part_b, joint;
    uint32_t kind;   /* scree_event_kind */
    float speed;     /* of a hit, m/s */
    float impulse;   /* of a begin or hit, N s */
    float point[3];  /* of a begin or hit */
    float normal[3]; /* from a to b */
} scree_event;
typedef struct scree_event_options {
    size_t size;
    int contacts;    /* begin and end */
    float hit_speed; /* m/s, least approach speed of a hit; needs contacts; 0: all that begin; infinity: none */
    int breaks, sleep, sensors;
} scree_event_options;
SCREE_API scree_result scree_world_set_events(scree_world* world, const scree_event_options* options);
SCREE_API scree_result scree_world_take_events(scree_world* world, scree_array* events); /* since they were taken last */

typedef struct scree_sensed {
    int64_t sensor, body;
    int32_t sensor_part, part;
} scree_sensed;
SCREE_API scree_result scree_world_sensed(scree_world* world, scree_array* overlaps);

/* ---- Measures of granular media, as the guide defines them */

/* What is measured from now on: "measures" of scene files, or null: those of the scene. copy: whose grains count, in a world of
 * several; else 0. Gates count crossings from the next step on, which are then waited for one by one. */
SCREE_API scree_result scree_world_set_measures(scree_world* world, const char* measures_json, size_t copy);
/* Measures the world as it is. json: "step"; "time", s; "cells" of the grid along x, y, z; "names" of "regions" (first "all", the
 * grains as a whole), "gates" and "bodies"; "columns": their names, such as "regions.stress", and numbers a row. */
SCREE_API scree_result scree_world_measure(scree_world* world, const char** json);
/* A column of what was measured last: double, row by row. Rows of grains.* are bodies, of grid.* cells, x fastest. */
SCREE_API scree_result scree_world_measured(scree_world* world, const char* column, scree_array* values);

/* ---- Joints and vehicles */

typedef struct scree_joint_state {
    float force[3], torque[3];      /* on its second body, N and N m, mean over the step */
    float max_force, max_torque;    /* greatest so far */
    float gap;                      /* between the anchors, m */
    float coordinates[6], rates[6]; /* along x, y, z, then about: m and rad, m/s and rad/s */
    uint32_t broken;
    uint32_t axis; /* of coordinates: along or about which it moves */
} scree_joint_state;
SCREE_API scree_result scree_world_joints(scree_world* world, scree_array* states);

typedef struct scree_drive {
    float stiffness, damping, target, target_speed, max_force, motor_speed, motor_force, friction, armature, lower, upper;
    uint32_t locked;
} scree_drive;
/* Of all joints. axis: 0 to 5 as of coordinates; -1: along or about which each moves. */
SCREE_API scree_result scree_world_drives(scree_world* world, int axis, scree_array* drives);
/* For some joints, on an axis; columns have one float for each joint, and what is left out stays.
 * "stiffness", "damping", "target", "target_speed", "max_force": servos. */
SCREE_API scree_result scree_world_set_drives(scree_world* world, const int64_t* joints, size_t count, int axis,
                                              const scree_column* columns, size_t column_count);
SCREE_API scree_result scree_world_set_motors(scree_world* world, const int64_t* joints, size_t count, int axis,
                                              const scree_column* columns,
                                              size_t column_count); /* speed, max_force: both needed */
SCREE_API scree_result scree_world_set_springs(scree_world* world, const int64_t* joints, size_t count, int axis,
                                               const char* spring_json);
SCREE_API scree_result scree_world_set_joint_coordinates(scree_world* world, const int64_t* joints, size_t count, int axis,
                                                         const scree_column* columns, size_t column_count); /* coordinate, rate */
SCREE_API scree_result scree_world_apply_joint_forces(scree_world* world, const int64_t* joints, size_t count, int axis,
                                                      const scree_column* columns, size_t column_count); /* force */
/* A joint in JSON, with bodies by index and anchors in their frames; or with anchor and axis here, in the world, else both null.
 */
SCREE_API scree_result scree_world_add_joint(scree_world* world, const char* joint_json, const float anchor[3],
                                             const float axis[3], size_t* index);
SCREE_API scree_result scree_world_remove_joint(scree_world* world, size_t joint);

typedef struct scree_vehicle_state {
    float throttle, brake, steer, hand_brake, speed, curvature; /* -1 to 1, ..., m/s, 1/m */
    int32_t passed, next;                                       /* points of its route */
    uint32_t by_route, arrived;
} scree_vehicle_state;
SCREE_API scree_result scree_world_vehicles(scree_world* world, scree_array* states);
SCREE_API scree_result scree_world_drive(scree_world* world, size_t vehicle, float throttle, float brake, float steer,
                                         float hand_brake);
SCREE_API scree_result scree_world_drive_by_route(scree_world* world, size_t vehicle);
SCREE_API scree_result scree_world_reset_upright(scree_world* world, size_t vehicle);

/* ---- Queries, in batches. Strides are those of the caller's records, sizeof of them. */

typedef struct scree_ray {
    float from[3], along[3]; /* along: unit */
    float reach;             /* m, above 0; infinity: no limit */
    uint32_t mask;           /* of categories of bodies that it sees: 0xFFFFFFFF all, 0 none */
    uint32_t solid;          /* 1: a body in which it begins is hit at distance 0; 0: is not seen */
    uint32_t copy;
} scree_ray;
typedef struct scree_hit {
    int64_t body; /* -1: none; then distance is infinite and point NaN */
    int32_t part; /* of a compound; of a mesh or height field the triangle */
    float distance, point[3], normal[3];
} scree_hit;
typedef struct scree_part {
    int64_t body;
    int32_t part;
} scree_part;
typedef struct scree_depth {
    int64_t body;
    int32_t part;
    float depth, normal[3]; /* moved by depth along the normal the shape only touches */
} scree_depth;

SCREE_API scree_result scree_world_cast_rays(scree_world* world, const scree_ray* rays, size_t count, size_t stride,
                                             scree_hit* hits, size_t hit_stride); /* the nearest of each */
SCREE_API scree_result scree_world_rays_hit(scree_world* world, const scree_ray* rays, size_t count, size_t stride, uint8_t* hit);
/* All hits of each; starts: count + 1 of uint64_t, of the caller; hits of ray i are starts[i] to starts[i + 1]. */
SCREE_API scree_result scree_world_cast_rays_through(scree_world* world, const scree_ray* rays, size_t count, size_t stride,
                                                     uint64_t* starts, scree_array* hits);

typedef struct scree_cast {
    float from[3], orientation[4], along[3];
    float reach; /* m, 0 or more */
    uint32_t mask;
    uint32_t solid; /* 0: what it overlaps at the start is hit only if it moves deeper in */
    uint32_t copy;
    int64_t ignored; /* a body that it passes through; -1: none */
} scree_cast;
/* shape_json: convex, or a compound. */
SCREE_API scree_result scree_world_cast_shapes(scree_world* world, const char* shape_json, const scree_cast* casts, size_t count,
                                               size_t stride, scree_hit* hits, size_t hit_stride);
typedef struct scree_placed {
    float position[3], orientation[4];
    uint32_t mask;
    int64_t ignored;
    uint32_t copy;
} scree_placed;
SCREE_API scree_result scree_world_overlaps(scree_world* world, const char* shape_json, const scree_placed* shapes, size_t count,
                                            size_t stride, uint64_t* starts, scree_array* parts); /* scree_part */
SCREE_API scree_result scree_world_penetrations(scree_world* world, const char* shape_json, const scree_placed* shapes,
                                                size_t count, size_t stride, uint64_t* starts,
                                                scree_array* depths); /* scree_depth */
typedef struct scree_point {
    float point[3], reach;
    uint32_t mask, copy;
} scree_point;
SCREE_API scree_result scree_world_closest_points(scree_world* world, const scree_point* points, size_t count, size_t stride,
                                                  scree_hit* hits, size_t hit_stride);

/* ---- Drawing and exports */

/* Lines and points of the world, for an engine's own drawing: by options, null for shapes, contacts and joints. */
typedef struct scree_debug_options {
    size_t size;
    int shapes, contacts, joints, boxes;
    int segments;                    /* of a circle; 0: 24 */
    float line_length, force_length; /* of normals and axes, m; of forces, m/N; 0: by default */
    const int64_t* bodies;           /* of these alone; null: of all */
    size_t body_count;
} scree_debug_options;
typedef struct scree_line {
    float from[3], to[3], color[3]; /* sRGB, 0 to 1 */
} scree_line;
typedef struct scree_dot {
    float position[3], color[3];
} scree_dot;
SCREE_API scree_result scree_world_debug_drawing(scree_world* world, const scree_debug_options* options, scree_array* lines,
                                                 scree_array* dots);

/* An offscreen picture and its channels, into the caller's memory, rows from the top; null: is not drawn. A side of color has 16
 * to 16384 pixels, times 2, 3 or 4 for 4, 9 or 16 samples. */
typedef struct scree_picture {
    size_t size;
    int width, height;       /* pixels, 1 to 16384 */
    const char* camera_json; /* as of scene files; null: the suggested one */
    const char* look_json;   /* the scene file's "picture", and caption, canvas, legend, shadows, samples; null: the scene's */
    const char* camera_before_json; /* for the flow; null: the same camera */
    double seconds_before;          /* likewise: to that picture */
    size_t copy;                    /* SCREE_ALL_COPIES: all, one beside the other */
    uint8_t* color;                 /* 3 for each pixel, sRGB */
    float* depth;                   /* m along the view; infinity: nothing */
    int32_t *body, *part;           /* -1: none */
    float* normal;                  /* 3, world axes */
    float* flow;                    /* 2, pixels */
} scree_picture;
SCREE_API scree_result scree_world_render(scree_world* world, const scree_picture* picture);
SCREE_API scree_result scree_world_canvas_name(scree_world* world, const char** name); /* what drew the last one, or "" */
SCREE_API scree_result scree_world_suggested_camera(scree_world* world, const char** camera_json);
/* Rays through the middles of pixels: from and along, 3 floats for each. */
SCREE_API scree_result scree_pixel_rays(const char* camera_json, int width, int height, float* from, float* along);
/* Bytes of a PNG file. channels: 1 or 3; bits: 8 or 16 (uint16_t). */
SCREE_API scree_result scree_png(const void* pixels, int width, int height, int channels, int bits, scree_array* bytes);

/* An animation (.glb or .usda) of the steps from now on, one pose every so many steps. clips: moments that a .usda keeps in files
 * of their own, 0: none. The file is there at once, and whole after scree_export_close or scree_world_release. */
typedef struct scree_export scree_export;
SCREE_API scree_result scree_world_export(scree_world* world, const char* path, int every, int clips, scree_export** made);
SCREE_API scree_result scree_export_close(scree_export* made);

/* A recording of the steps from now on, in memory, as a page that plays it in any browser. */
typedef struct scree_recording scree_recording;
typedef struct scree_record_options {
    size_t size;
    const char* title;       /* null: the scene's */
    const char* camera_json; /* as of scene files; null: the suggested one */
    const char* look_json;   /* as of scree_picture */
    double fps;              /* frames a second of time, 0.001 to 1e6, in whole steps; 0: 30 */
    size_t copy;             /* SCREE_ALL_COPIES: all, one beside the other */
    int contacts;            /* 1: recorded, -1: not; 0: of at most 2000 bodies */
    int events;              /* 1: hits and breaks, which takes the world's events */
    int live;                /* 1: nothing is kept: for scree_recording_take */
} scree_record_options;
/* options may be null. The page is given also after the world was released. SCREE_IMPOSSIBLE without the viewer in the library.
 */
SCREE_API scree_result scree_world_record(scree_world* world, const scree_record_options* options, scree_recording** made);
SCREE_API scree_result scree_recording_count(scree_recording* recording, uint64_t* frames);
SCREE_API scree_result scree_recording_page(scree_recording* recording, scree_array* bytes); /* so far; HTML in UTF-8 */
SCREE_API scree_result scree_recording_save(scree_recording* recording, const char* path);   /* the page */
/* Of a live one: chunks (demos/docs/guide/viewer.md) of what is new in the scene since the last call, at first of all; frame: 1:
 * and a frame of now. */
SCREE_API scree_result scree_recording_take(scree_recording* recording, int frame, scree_array* bytes);
SCREE_API scree_result scree_recording_stop(scree_recording* recording); /* later steps are not recorded */
SCREE_API void scree_recording_release(scree_recording* recording);      /* null is allowed */

/* ---- The program */

/* Runs a command of the program scree ("scree", "run", "wall", ...), which writes to the standard streams and hears SIGINT.
 * Returns its exit status: 0 done, 1 failed, 2 wrong usage, 130 interrupted. There is no window. */
SCREE_API int scree_command(int argc, const char* const* argv);

#ifdef __cplusplus
}
#endif

#endif
