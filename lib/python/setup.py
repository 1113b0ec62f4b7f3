"""Builds the wheel: CMake builds the extension module from the libraries of the project around.

tools/dev python calls it. ESPALIER_PYTHON_BUILD names the build folder, which is kept, by default build/python.
ESPALIER_IMPORT=OFF builds a wheel that reads no mesh files and needs none of the libraries for them.
"""

import os
import pathlib
import re
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parent.parent
READS_FILES = os.environ.get("ESPALIER_IMPORT", "ON") == "ON"


class CMakeBuild(build_ext):
    def build_extension(self, extension: Extension) -> None:
        folder = pathlib.Path(os.environ.get("ESPALIER_PYTHON_BUILD", PROJECT / "build" / "python"))
        off = [f"-DESPALIER_{part}=OFF" for part in ("TOOLS", "TESTS", "BENCH", "INSTALL")]
        subprocess.run(
            ["cmake", "-S", str(PROJECT), "-B", str(folder), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
             "-DESPALIER_PYTHON=ON", f"-DESPALIER_PYTHON_INTERPRETER={sys.executable}",
             f"-DESPALIER_IMPORT={'ON' if READS_FILES else 'OFF'}", *off], check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "espalier_python"], check=True)
        name = extension.name.split(".")[-1] + sysconfig.get_config_var("EXT_SUFFIX")
        built = folder / "lib" / "python" / "package" / "espalier" / name
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(built), str(target))


def version() -> str:
    return re.search(r"VERSION (\d+\.\d+\.\d+)", (PROJECT / "CMakeLists.txt").read_text().split("project(", 1)[1])[1]


setup(
    name="espalier",
    version=version(),
    description="Baked collision meshes, queried straight from their bytes",
    license="MIT",
    python_requires=">=3.9",
    install_requires=["numpy>=1.21"],
    packages=["espalier", "espalier.trimesh"],
    package_data={"espalier": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("espalier._core", [])] + ([Extension("espalier._import", [])] if READS_FILES else []),
    cmdclass={"build_ext": CMakeBuild},
    zip_safe=False,
)
