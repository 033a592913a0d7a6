/* Minimal fcntl.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_FCNTL_H
#define ROBOSMI_FCNTL_H
#include <sys/types.h>
#define O_RDONLY 0
#define O_WRONLY 1
#define O_RDWR 2
#define O_CREAT 0100
#define O_TRUNC 01000
#define O_APPEND 02000
int open(const char *name, int flags, ...);
int creat(const char *name, mode_t mode);
int fcntl(int file, int command, ...);
#endif
