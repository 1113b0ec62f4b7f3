"""A recipe for Conan 2, which packages the source tree around it."""

import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

PROJECT = os.path.join("..", "..", "..")


class Espalier(ConanFile):
    name = "espalier"
    description = "Baked collision meshes, queried straight from their bytes"
    license = "MIT"
    settings = "os", "arch", "compiler", "build_type"
    package_type = "static-library"
    options = {"import": [True, False], "tools": [True, False]}
    default_options = {"import": False, "tools": False}

    def set_version(self):
        text = load(self, os.path.join(self.recipe_folder, PROJECT, "CMakeLists.txt"))
        self.version = re.search(r"project\(espalier VERSION ([0-9.]+)", text).group(1)

    def export_sources(self):
        source = os.path.join(self.recipe_folder, PROJECT)
        for pattern in ("CMakeLists.txt", "LICENSE", "lib/*", "tools/*", "docs/schema/*", "docs/examples/*"):
            copy(self, pattern, source, self.export_sources_folder)

    def validate(self):
        check_min_cppstd(self, 20)

    def requirements(self):
        if self.reads_files():
            for package in ("assimp/5.4.3", "draco/1.5.6", "expat/2.6.3", "meshoptimizer/0.20", "nlohmann_json/3.11.3",
                            "zlib/1.3.1"):
                self.requires(package)
        if self.options.tools:
            for package in ("cli11/2.4.2", "libpng/1.6.43"):
                self.requires(package)

    def reads_files(self):
        return bool(self.options.get_safe("import")) or bool(self.options.tools)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["ESPALIER_TOOLS"] = bool(self.options.tools)
        toolchain.cache_variables["ESPALIER_IMPORT"] = self.reads_files()
        toolchain.cache_variables["ESPALIER_TESTS"] = False
        toolchain.cache_variables["ESPALIER_BENCH"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # The package brings its own files for find_package(), with the components runtime, baker and import.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "espalier")]
        self.cpp_info.libs = ["espalier_baker", "espalier_runtime"]
        if self.reads_files():
            self.cpp_info.libs.insert(0, "espalier_import")
        if self.settings.os == "Linux":
            self.cpp_info.system_libs = ["pthread"]
