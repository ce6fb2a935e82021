// What the sanitizers are told by default, in the tests and the program. Variables as ASAN_OPTIONS override it.
//
// Drivers and libraries that keep memory to the end of the process are named; a leak of scree's own is found all the same.
extern "C" {

// Drivers stay loaded to the end: the report at exit finds the names of libraries that are still there.
int dlclose(void* /*library*/) {
    return 0;
}

const char* __lsan_default_suppressions() {
    return "leak:libLLVM\n"
           "leak:libvulkan\n"
           "leak:libVkLayer\n"
           "leak:libEGL\n"
           "leak:libGLX\n"
           "leak:libgallium\n"
           "leak:swrast_dri\n"
           "leak:libX11\n"
           "leak:libxcb\n"
           "leak:mca_\n"
           "leak:libpmix\n"
           "leak:libmpi\n"
           "leak:libopen-pal\n"
           "leak:libopen-rte\n";
}

// These are not compiled with the thread sanitizer, which does not see how they order their threads.
const char* __tsan_default_suppressions() {
    return "race:libLLVM\n"
           "race:libEGL\n"
           "race:libembree\n"
           "race:libgallium\n"
           "race:swrast_dri\n"
           "race:mca_\n"
           "race:libmpi\n"
           "race:libopen-pal\n"
           "race:libopen-rte\n"
           "deadlock:mca_\n"
           "deadlock:libmpi\n"
           "deadlock:libopen-pal\n"
           "deadlock:libopen-rte\n";
}

const char* __lsan_default_options() {
    return "print_suppressions=0";
}

const char* __tsan_default_options() {
    return "print_suppressions=0";
}

const char* __ubsan_default_options() {
    return "print_stacktrace=1";
}
}
