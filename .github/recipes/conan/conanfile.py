# Draft for Conan 2; see ../README.md.
from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, get, rm, rmdir


class Scree(ConanFile):
    name = "scree"
    version = "@VERSION@"
    description = "Rigid body simulator with the same bits on every GPU and CPU"
    license = "MIT"
    topics = ("physics", "simulation", "deterministic")
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"fPIC": [True, False]}
    default_options = {"fPIC": True}

    def validate(self):
        check_min_cppstd(self, 20)
        if self.settings.compiler not in ("gcc", "clang", "apple-clang"):
            raise ConanInvalidConfiguration("scree is compiled by GCC or clang")

    def layout(self):
        cmake_layout(self, src_folder="src")

    def requirements(self):
        for one in ("onetbb/2021.12.0", "glm/1.0.1", "xxhash/0.8.2", "qhull/8.0.2", "tinyxml2/10.0.0", "tinyobjloader/1.0.7",
                    "tinygltf/2.9.0", "nlohmann_json/3.11.3", "stb/cci.20240213"):
            self.requires(one)

    def build_requirements(self):
        self.tool_requires("cmake/[>=3.25]")

    def source(self):
        get(self, "@SOURCE@", sha256="@SHA256@", strip_root=True)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for part in ("SCREE_VULKAN", "SCREE_PROGRAM", "SCREE_WINDOW", "SCREE_PYTHON", "SCREE_MPI", "SCREE_TESTS"):
            toolchain.variables[part] = False
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, f"{self.package_folder}/licenses")
        CMake(self).install()
        rmdir(self, f"{self.package_folder}/lib/pkgconfig")
        rm(self, "*.pdb", self.package_folder, recursive=True)

    def package_info(self):
        # scree's own configuration knows its targets and flags.
        self.cpp_info.builddirs = ["lib/cmake/scree"]
        self.cpp_info.set_property("cmake_find_mode", "none")
