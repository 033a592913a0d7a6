class Broken {};
