// prepare_ray as it is defined, for instruction sets without a way of their own. Included inside their namespaces.

template <class Lanes>
bool prepare(const BlobData& blob, const Ray& world, PreparedRayIn<Lanes>& prepared) {
    return prepare_ray(blob, world, prepared);
}
template <class Lanes>
bool prepare(const BlobData& blob, const RayOnLattice& given, PreparedRayIn<Lanes>& prepared) {
    return prepare_ray(blob, given, prepared);
}
