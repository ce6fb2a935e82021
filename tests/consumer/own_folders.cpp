// A program with folders compute and host of its own, before the library's on the include path; prints "ok".
#include <compute/queries.h>
#include <host/device_error.h>
#include <scree/compute/queries.h>
#include <scree/compute/world.h>

#include <cstdio>

int main() {
    const scree::RayQuery ray;
    if (own_queries + own_errors != 7 || !(ray.reach > 0)) return 1;
    std::printf("ok\n");
}
