/* Minimal unistd.h for reading programs (names and types only): what the sys/unistd.h of propgcc declares, so that a
   program may call its own functions `alarm` or `access`. */
#ifndef ROBOSMI_UNISTD_H
#define ROBOSMI_UNISTD_H
#include <sys/types.h>
#define STDIN_FILENO 0
#define STDOUT_FILENO 1
#define STDERR_FILENO 2
unsigned int sleep(unsigned int seconds);
int usleep(useconds_t microseconds);
ssize_t read(int file, void *to, size_t n);
ssize_t write(int file, const void *from, size_t n);
int close(int file);
off_t lseek(int file, off_t offset, int whence);
int rmdir(const char *name);
int chdir(const char *name);
char *getcwd(char *to, size_t n);
int isatty(int file);
#endif
