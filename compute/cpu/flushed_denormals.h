// Denormals flushed to zero on this thread, as Vulkan lets devices do (shaderDenormPreserveFloat32).
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace scree {

// Flushes denormal operands and results until the end of the scope: by MXCSR on x86, by FPCR on 64-bit ARM.
class FlushedDenormals {
public:
#if defined(__x86_64__)
    static constexpr bool possible = true;
    FlushedDenormals() : before_(_mm_getcsr()) {
        _mm_setcsr(before_ | flush_results | operands_are_zero);
    }
    ~FlushedDenormals() {
        _mm_setcsr(before_);
    }

private:
    static constexpr unsigned flush_results = 0x8000, operands_are_zero = 0x0040;
    unsigned before_;
#elif defined(__aarch64__)
    static constexpr bool possible = true;
    FlushedDenormals() {
        asm volatile("mrs %0, fpcr" : "=r"(before_));
        asm volatile("msr fpcr, %0" ::"r"(before_ | flush_to_zero));
    }
    ~FlushedDenormals() {
        asm volatile("msr fpcr, %0" ::"r"(before_));
    }

private:
    static constexpr unsigned long flush_to_zero = 1ul << 24;
    unsigned long before_ = 0;
#else
    static constexpr bool possible = false;
    FlushedDenormals() = default;

private:
#endif
    FlushedDenormals(const FlushedDenormals&) = delete;
    FlushedDenormals& operator=(const FlushedDenormals&) = delete;
};

}  // namespace scree
