/* Minimal errno.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_ERRNO_H
#define ROBOSMI_ERRNO_H
extern int errno;
#define EDOM 33
#define ERANGE 34
#define EILSEQ 84
#define ENOENT 2
#define EIO 5
#define EBADF 9
#define EAGAIN 11
#define ENOMEM 12
#define EACCES 13
#define EINVAL 22
#endif
