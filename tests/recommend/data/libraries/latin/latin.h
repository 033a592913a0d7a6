// Mühle
class Latin {};
