# How programs are linked. A program of Plastron draws in some 200 shared libraries: GNU ld takes 20 to 35 s to look through them, mold 0.7 s.
find_program(PLASTRON_MOLD mold)
if(PLASTRON_MOLD)
  add_link_options(-fuse-ld=mold)
endif()
