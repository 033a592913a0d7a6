//# header sys/stat.h
// Folders of a card are made. Read from propgcc b280e7a77, lib/misc/mkdir.c.

//# adapter mkdir
//#   for: int mkdir(const char *path, int mode)
//#   kind: oneToOne
//#   include: <SD.h>
//#   library: SD
//#   fidelity: exact: 0, or -1 where it cannot be made or is there already; the mode has no effect, as there
//#   stack: 0
inline int32_t mkdir(const char *path, int32_t mode) {
  (void)mode;
  return !SD.exists(path) && SD.mkdir(path) ? 0 : -1;
}
