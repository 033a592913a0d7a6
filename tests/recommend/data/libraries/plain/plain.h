/* Reads a RoboSense 9 sensor. */
class Plain {
 public:
  int readDistance();  // in "cm"
};
