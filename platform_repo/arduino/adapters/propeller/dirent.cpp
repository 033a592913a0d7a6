//# header dirent.h
// Folders of a card. Read from propgcc b280e7a77, lib/include/dirent.h, lib/misc/opendir.c.

//# type dirent
//#   fidelity: exact: its members in their order
struct dirent {
  uint8_t name[11], attr, reserved, crttimetenth, crttime_0, crttime_1, crtdate_0, crtdate_1, lstaccdate_l, lstaccdate_h;
  uint8_t startcluster_2, startcluster_3, wrttime_0, wrttime_1, wrtdate_0, wrtdate_1, startcluster_0, startcluster_1;
  uint8_t filesize_0, filesize_1, filesize_2, filesize_3;
  char d_name[13];
};

//# type DIR
//#   needs: dirent
//#   include: <SD.h>
//#   library: SD
//#   fidelity: an open folder, and its entry that was read last
struct DIR {
  File folder;
  struct dirent entry;
};

//# constant ATTR_READ_ONLY
//#   fidelity: exact
#define ATTR_READ_ONLY 0x01

//# constant ATTR_HIDDEN
//#   fidelity: exact
#define ATTR_HIDDEN 0x02

//# constant ATTR_SYSTEM
//#   fidelity: exact
#define ATTR_SYSTEM 0x04

//# constant ATTR_VOLUME_ID
//#   fidelity: exact
#define ATTR_VOLUME_ID 0x08

//# constant ATTR_DIRECTORY
//#   fidelity: exact
#define ATTR_DIRECTORY 0x10

//# constant ATTR_ARCHIVE
//#   fidelity: exact
#define ATTR_ARCHIVE 0x20

//# adapter opendir
//#   for: DIR *opendir(const char *path)
//#   kind: semantic
//#   needs: DIR
//#   include: <SD.h>
//#   library: SD
//#   fidelity: exact: 0 where there is no such folder
//#   stack: 28 24
inline DIR *opendir(const char *path) {
  if (path[0] == '.' && (!path[1] || path[1] == '/')) path++;  // the folder of the program is that of the card
  File folder = SD.open(*path ? path : "/");
  if (!folder) return 0;
  if (!folder.isDirectory()) {
    folder.close();
    return 0;
  }
  DIR *opened = new DIR();
  if (opened) opened->folder = folder;
  return opened;
}

//# adapter readdir
//#   for: struct dirent *readdir(DIR *dirp)
//#   kind: semantic
//#   needs: DIR dirent ATTR_DIRECTORY ATTR_ARCHIVE
//#   include: <SD.h>
//#   library: SD
//#   fidelity: the name in both forms, the size, and whether it is a folder; 0 behind the last one
//#   limit: the library of the card tells no times and no further attributes: a file has ATTR_ARCHIVE, and the entries . and .. are left out
//#   stack: 33 24
inline struct dirent *readdir(DIR *dirp) {
  File found = dirp->folder.openNextFile();
  if (!found) return 0;
  struct dirent &entry = dirp->entry;
  memset(&entry, 0, sizeof entry);
  memset(entry.name, ' ', sizeof entry.name);
  strncpy(entry.d_name, found.name(), sizeof entry.d_name - 1);
  uint8_t at = 0;
  for (const char *letter = entry.d_name; *letter; letter++) {
    if (*letter == '.') at = 8;
    else if (at < sizeof entry.name) entry.name[at++] = *letter;
  }
  uint32_t size = found.size();
  entry.attr = found.isDirectory() ? ATTR_DIRECTORY : ATTR_ARCHIVE;
  entry.filesize_0 = size;
  entry.filesize_1 = size >> 8;
  entry.filesize_2 = size >> 16;
  entry.filesize_3 = size >> 24;
  found.close();
  return &entry;
}

//# adapter closedir
//#   for: int closedir(DIR *dirp)
//#   kind: oneToMany
//#   needs: DIR
//#   include: <SD.h>
//#   library: SD
//#   fidelity: exact: 0, or -1 without a folder
//#   stack: 4
inline int32_t closedir(DIR *dirp) {
  if (!dirp) return -1;
  dirp->folder.close();
  delete dirp;
  return 0;
}
