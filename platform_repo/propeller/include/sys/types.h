/* Minimal sys/types.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_SYS_TYPES_H
#define ROBOSMI_SYS_TYPES_H
#include <stddef.h>
typedef int ssize_t;
typedef int off_t;
typedef int pid_t;
typedef unsigned int mode_t;
typedef unsigned int useconds_t;
typedef long suseconds_t;
typedef unsigned int ino_t;
typedef unsigned int dev_t;
typedef unsigned int uid_t;
typedef unsigned int gid_t;
#endif
