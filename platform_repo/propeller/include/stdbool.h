/* Minimal stdbool.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_STDBOOL_H
#define ROBOSMI_STDBOOL_H
#ifndef __cplusplus
#define bool _Bool
#define true 1
#define false 0
#endif
#define __bool_true_false_are_defined 1
#endif
