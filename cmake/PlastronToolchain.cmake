# How programs are linked. A program of Plastron draws in some 200 shared libraries: GNU ld takes 20 to 35 s to look through them, mold 0.7 s.
find_program(PLASTRON_MOLD mold)
if(PLASTRON_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

# The debug preset's flags: little optimisation, so that sanitized tests take a few times as long and not twenty times; line numbers for messages.
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g1")
if(PLASTRON_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  # What a wrong pointer does next the address sanitizer sees; these checks cost a third of the compiler's time.
  add_compile_options(-fno-sanitize=vptr,null,alignment,object-size,pointer-overflow,nonnull-attribute,returns-nonnull-attribute)
  # Gmsh brings its own instances of Eigen's templates, which share our symbols: both must agree on how memory is aligned, and under the
  # address sanitizer Eigen would align by itself.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()

# Position-independent everywhere, so that shared libraries of others may take ours in. An option and not CMake's property: programs would get
# -fPIE from that, and precompiled headers serve one of the two only.
add_compile_options(-fPIC)
