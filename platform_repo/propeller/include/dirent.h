/* Minimal dirent.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_DIRENT_H
#define ROBOSMI_DIRENT_H
#include <sys/types.h>
struct dirent { ino_t d_ino; off_t d_size; char d_name[256]; };
typedef struct robosmi_dir DIR;
DIR *opendir(const char *name);
struct dirent *readdir(DIR *folder);
int closedir(DIR *folder);
void rewinddir(DIR *folder);
#endif
