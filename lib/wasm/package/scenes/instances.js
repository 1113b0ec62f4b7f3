// Instances as arguments: their places, meshes, masks and users' numbers, and the handles that name them.
import { integerColumn } from '../arguments.js';
import { fieldsOfPlaces } from '../places.js';

/// Shares a bit with every mask but 0.
export const ALL = 0xFFFFFFFF;

/// Makes the arguments of instances, each for one of them or for all.
export function fieldsOfInstances({ mesh = 0, mask = ALL, user = 0, ...places } = {}) {
    return {
        ...fieldsOfPlaces(places, 'instances'), mesh: integerColumn(mesh, 'mesh'), mask: integerColumn(mask, 'mask'),
        user: integerColumn(user, 'user'), source: integerColumn(0, 'source'),
    };
}

/// Makes the arguments of handles.
export function fieldsOfHandles(handles) {
    if (handles?.slot === undefined || handles.generation === undefined)
        throw new TypeError('handles must be those that insert() returned: an object with slot and generation');
    return {
        slot: integerColumn(handles.slot, 'handles.slot'), generation: integerColumn(handles.generation, 'handles.generation'),
    };
}
