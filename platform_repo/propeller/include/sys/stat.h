/* Minimal sys/stat.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_SYS_STAT_H
#define ROBOSMI_SYS_STAT_H
#include <sys/types.h>
#include <time.h>
struct stat { mode_t st_mode; off_t st_size; time_t st_atime, st_mtime, st_ctime; };
#define S_IFMT 0170000
#define S_IFDIR 0040000
#define S_IFREG 0100000
#define S_ISDIR(mode) (((mode) & S_IFMT) == S_IFDIR)
#define S_ISREG(mode) (((mode) & S_IFMT) == S_IFREG)
int stat(const char *name, struct stat *to);
int fstat(int file, struct stat *to);
int mkdir(const char *name, mode_t mode);
#endif
