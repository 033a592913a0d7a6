/* SD cards: the functions are declared where simpletools.h declares them. */
#ifndef ROBOSMI_SYS_SD_H
#define ROBOSMI_SYS_SD_H
#endif
