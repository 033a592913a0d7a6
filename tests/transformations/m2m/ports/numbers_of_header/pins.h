#define SENSOR_BASE 2
#define PING_PIN (SENSOR_BASE + 6) /* P8 */
#define CHANNEL 1                  /* of the converter */
