#ifndef CONFIG_H
#define CONFIG_H

/* Settings */
#define WHEEL_PIN 16
#define PERIOD    20

#endif
