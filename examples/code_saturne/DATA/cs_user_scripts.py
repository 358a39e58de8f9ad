"""What `code_saturne run` asks a case for: the mesh, and how the user sources find clast. drive.py writes build.txt."""
import os


def define_domain_parameters(domain):
    with open(os.path.join(domain.data_dir, "build.txt")) as f:
        mesh, include, library = (line.rstrip("\n") for line in f)
    domain.meshes = [mesh]
    domain.compile_cflags = f"-I{include}"
    domain.compile_libs = f"-L{library} -Wl,-rpath,{library} -lclast -lm"
