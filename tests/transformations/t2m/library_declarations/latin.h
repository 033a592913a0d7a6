// Grüße, 20 °C
class Latin { public: void heat(const char *unit = "°C"); };
#define UNIT "°C"
