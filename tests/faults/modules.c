/* LD_PRELOAD shim: prints, as the program ends, how many modules Mesa asked LLVM for: one for each shader it compiles or takes from
   its cache. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <link.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

typedef void* (*Create)(const char*, void*);
static atomic_long modules;
static _Atomic(Create) create;

static int look(struct dl_phdr_info* info, size_t size, void* found) {
    (void)size;
    (void)found;
    if (!strstr(info->dlpi_name, "libLLVM")) return 0;
    void* library = dlopen(info->dlpi_name, RTLD_LAZY | RTLD_NOLOAD);
    if (library) create = (Create)dlsym(library, "LLVMModuleCreateWithNameInContext");
    return create != NULL;
}

void* LLVMModuleCreateWithNameInContext(const char* name, void* context) {
    ++modules;
    if (!create) dl_iterate_phdr(look, NULL);
    return create ? create(name, context) : NULL;
}

__attribute__((destructor)) static void end(void) {
    fprintf(stderr, "modules %ld\n", (long)modules);
}
