"""What `code_saturne run` asks a case for: the mesh, and how the user sources find clast. drive.py writes build.txt."""
import os


def define_domain_parameters(domain):
    with open(os.path.join(domain.data_dir, "build.txt")) as f:
        mesh, include, library = (line.rstrip("\n") for line in f)
    domain.meshes = [mesh]
    has_ranks = os.path.exists(os.path.join(library, "libclast_mpi.so"))
    domain.compile_cflags = f"-I{include}" + (" -DHAVE_CLAST_MPI" if has_ranks else "")
    domain.compile_libs = f"-L{library} -Wl,-rpath,{library}{' -lclast_mpi' if has_ranks else ''} -lclast -lm"
