/* Minimal sys/unistd.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_SYS_UNISTD_H
#define ROBOSMI_SYS_UNISTD_H
#include <unistd.h>

#endif
