// Calls of POSIX that scree is linked with and emscripten lacks: each says that it is not there, which its callers expect.
#include <cerrno>

extern "C" {

int memfd_create(const char*, unsigned) {
    errno = ENOSYS;
    return -1;
}
int prctl(int, ...) {
    errno = ENOSYS;
    return -1;
}

}  // extern "C"
