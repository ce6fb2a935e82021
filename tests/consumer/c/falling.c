/* A program in C that uses the installed library: a ball falls on the ground; prints where it lies, and what it costs to ask
 * wrongly. */
#include <scree/scree.h>
#include <stdio.h>
#include <string.h>

static int failed(const char* what) {
    fprintf(stderr, "%s: %s\n", what, scree_error_message());
    return 1;
}

int main(void) {
    const float places[2][3] = {{0, 2, 0}, {3, 4, 0}};
    const scree_column columns[] = {{"position", places[0], sizeof places[0]}};
    float now[3][3];
    const scree_output outputs[] = {{"position", now, sizeof now[0]}};
    scree_world_options options = SCREE_INIT(scree_world_options);
    scree_array contacts;
    scree_scene* scene = NULL;
    scree_world* world = NULL;
    uint64_t hash = 0;

    if (scree_scene_create(&scene)) return failed("scene");
    if (scree_scene_add_bodies(scene, "{\"motion\": \"fixed\", \"shape\": {\"plane\": {}}}", 1, NULL, 0, NULL))
        return failed("ground");
    if (scree_scene_add_bodies(scene, "{\"shape\": {\"sphere\": {\"radius\": 0.5}}}", 2, columns, 1, NULL))
        return failed("balls");
    options.backend = "cpu";
    if (scree_world_create(scene, &options, &world)) return failed("world");
    if (scree_world_step(world, 240, NULL, NULL)) return failed("step");
    if (scree_world_read(world, outputs, 1, 3)) return failed("read");
    if (scree_world_contacts(world, &contacts)) return failed("contacts");
    printf("the balls lie at %.2f and %.2f m, in %d contacts", now[1][1], now[2][1], (int)contacts.count);
    if (scree_world_hash(world, &hash)) return failed("hash");
    printf("; state %016llx\n", (unsigned long long)hash);

    scree_world_release(world);
    if (scree_world_step(world, 1, NULL, NULL) != SCREE_BAD_HANDLE) return failed("a released world");
    if (scree_scene_add_bodies(scene, "{\"shape\": {\"sphere\": {\"radius\": -1}}}", 1, NULL, 0, NULL) == SCREE_OK &&
        scree_world_create(scene, &options, &world) != SCREE_BAD_SCENE)
        return failed("a radius below 0");
    if (strcmp(scree_error_place(), "/bodies/3/shape/sphere/radius") != 0) return failed(scree_error_place());
    scree_scene_release(scene);
    return 0;
}
