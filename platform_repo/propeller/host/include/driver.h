/* Drivers of propgcc's files: programs only name them. */
#ifndef ROBOSMI_DRIVER_H
#define ROBOSMI_DRIVER_H
typedef struct robosmi_driver _Driver;
#endif
