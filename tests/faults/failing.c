/* LD_PRELOAD shim: the N-th allocation of SCREE_FAIL_ALLOCATION=N bytes-or-more calls fails, or all from it on with
   SCREE_FAIL_REST=1; the write that passes byte SCREE_FAIL_BYTE=N of all files under SCREE_FAIL_FOLDER fails with ENOSPC, and all
   after it. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static atomic_long allocations, written;
static long fail_at = -1, fail_byte = -1;
static int rest, counts;
static const char* folder;

__attribute__((constructor)) static void begin(void) {
    const char* said = getenv("SCREE_FAIL_ALLOCATION");
    if (said) fail_at = atol(said);
    rest = getenv("SCREE_FAIL_REST") != NULL;
    counts = getenv("SCREE_COUNT") != NULL;
    said = getenv("SCREE_FAIL_BYTE");
    if (said) fail_byte = atol(said);
    folder = getenv("SCREE_FAIL_FOLDER");
}

__attribute__((destructor)) static void end(void) {
    if (counts) fprintf(stderr, "allocations %ld written %ld\n", (long)allocations, (long)written);
}

static int refuses(void) {
    const long n = atomic_fetch_add(&allocations, 1);
    return fail_at >= 0 && (n == fail_at || (rest && n > fail_at));
}

extern void* __libc_malloc(size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_memalign(size_t, size_t);

void* malloc(size_t size) {
    if (refuses()) return errno = ENOMEM, NULL;
    return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
    if (refuses()) return errno = ENOMEM, NULL;
    return __libc_calloc(count, size);
}
void* realloc(void* was, size_t size) {
    if (refuses()) return errno = ENOMEM, NULL;
    return __libc_realloc(was, size);
}
void* aligned_alloc(size_t by, size_t size) {
    if (refuses()) return errno = ENOMEM, NULL;
    return __libc_memalign(by, size);
}
int posix_memalign(void** made, size_t by, size_t size) {
    if (refuses()) return ENOMEM;
    *made = __libc_memalign(by, size);
    return *made ? 0 : ENOMEM;
}

static int is_output(int file) {
    char link[64], path[4096];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t n = readlink(link, path, sizeof path - 1);
    if (n <= 0) return 0;
    path[n] = 0;
    return folder && strncmp(path, folder, strlen(folder)) == 0;
}

ssize_t write(int file, const void* bytes, size_t count) {
    static ssize_t (*real)(int, const void*, size_t);
    if (!real) real = (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
    if (folder && is_output(file)) {
        const long before = atomic_fetch_add(&written, (long)count);
        if (fail_byte >= 0 && before + (long)count > fail_byte) {
            if (before < fail_byte) return real(file, bytes, (size_t)(fail_byte - before));
            return errno = ENOSPC, -1;
        }
    }
    return real(file, bytes, count);
}
