use super::header::{Header, vector};
use crate::header_text::quoted;

/// Axes beyond which NRRD itself does not go.
const MOST_AXES: usize = 16;

/// What the axes of a NRRD array mean.
#[derive(Debug, PartialEq)]
pub(crate) struct Axes {
    /// Samples along each axis, the fastest first.
    pub sizes: Vec<u64>,
    /// The axes of space, the fastest first; two for an image.
    pub spatial: Vec<usize>,
    /// The axis along which volumes are counted: time, or a list.
    pub step: Option<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Role {
    Spatial,
    Step,
    /// One value per sample, so that the axis can be left out.
    Single,
    /// The header does not say.
    Unknown,
}

impl Axes {
    pub fn read(header: &Header, notes: &mut Vec<String>) -> Result<Self, String> {
        let dimension =
            header.numbers::<usize>("dimension", 1)?.ok_or("the field \"dimension\" is missing")?[0];
        if !(1..=MOST_AXES).contains(&dimension) {
            return Err(format!("the field \"dimension\" is {dimension}; volumes have 3, or 4 with time"));
        }
        let sizes: Vec<u64> = header.numbers("sizes", dimension)?.ok_or("the field \"sizes\" is missing")?;
        let mut roles = roles(header, &sizes)?;
        settle_unknown(&mut roles, &sizes, notes)?;
        settle_beyond_three(&mut roles, &sizes, notes);

        let with = |role| (0..dimension).filter(|&axis| roles[axis] == role).collect::<Vec<_>>();
        let (spatial, steps) = (with(Role::Spatial), with(Role::Step));
        if !(2..=3).contains(&spatial.len()) {
            return Err(format!("there are {} axes of space; a volume has 3, an image 2", spatial.len()));
        }
        if steps.len() > 1 {
            return Err(format!("there are {} axes of time or list; one is read", steps.len()));
        }
        Ok(Self { sizes, spatial, step: steps.first().copied() })
    }

    /// Samples along x, y and z.
    pub fn spatial_sizes(&self) -> [u64; 3] {
        std::array::from_fn(|axis| self.spatial.get(axis).map_or(1, |&axis| self.sizes[axis]))
    }

    /// Number of volumes.
    pub fn steps(&self) -> u64 {
        self.step.map_or(1, |axis| self.sizes[axis])
    }

    /// Voxels of one volume that lie together before those of the next.
    pub fn run_voxels(&self) -> u64 {
        let faster = self.step.unwrap_or(self.sizes.len());
        self.sizes[..faster].iter().fold(1, |product, &size| product.saturating_mul(size))
    }
}

fn roles(header: &Header, sizes: &[u64]) -> Result<Vec<Role>, String> {
    let kinds = header.words("kinds", sizes.len())?;
    let directions = header.words("spacedirections", sizes.len())?;
    let world_has_time = header.field("space").is_some_and(super::grid::has_time);
    let role = |axis: usize| {
        let size = sizes[axis];
        let kind = kinds.as_ref().map(|kinds| kinds[axis].to_ascii_lowercase());
        let direction = directions.as_ref().map(|directions| vector(&directions[axis])).transpose()?;
        let along_time = |vector: &[f64]| world_has_time && vector.iter().take(3).all(|&part| part == 0.0);
        Ok(match (kind.as_deref(), direction) {
            (Some("time" | "list"), _) => Role::Step,
            (_, Some(Some(vector))) if along_time(&vector) => Role::Step,
            (Some("domain" | "space"), None | Some(Some(_))) | (_, Some(Some(_))) => Role::Spatial,
            (Some("domain" | "space" | "???" | "none") | None, Some(None)) => Role::Unknown,
            (Some("???" | "none") | None, None) => Role::Unknown,
            (Some("complex"), _) => {
                return Err("complex numbers are not read; save their magnitude".to_owned());
            }
            (Some(_), _) if size == 1 => Role::Single,
            (Some(kind), _) => {
                return Err(format!(
                    "each voxel holds {size} numbers (axis {axis} is of kind {}); only scalar volumes are read, \
                     save one component",
                    quoted(kind)
                ));
            }
        })
    };
    (0..sizes.len()).map(role).collect()
}

/// Decides the axes of which the header says nothing: three of them are space, and what is slower is a list.
fn settle_unknown(roles: &mut [Role], sizes: &[u64], notes: &mut Vec<String>) -> Result<(), String> {
    let known = roles.iter().filter(|&&role| role == Role::Spatial).count();
    if known >= 2 {
        for axis in 0..roles.len() {
            if roles[axis] != Role::Unknown {
                continue;
            }
            roles[axis] = match sizes[axis] {
                1 => Role::Single,
                // Slower than all of space it can only count volumes; faster, it may be the parts of a vector.
                _ if roles[..axis].iter().filter(|&&role| role == Role::Spatial).count() == known => {
                    Role::Step
                }
                size => {
                    return Err(format!(
                        "axis {axis} of {size} samples has neither kind nor direction, so it may be components or \
                         time; add \"kinds\" to the header"
                    ));
                }
            };
        }
        return Ok(());
    }
    let unknown: Vec<usize> = (0..roles.len()).filter(|&axis| roles[axis] == Role::Unknown).collect();
    for (place, &axis) in unknown.iter().enumerate() {
        roles[axis] = match (known + place, sizes[axis]) {
            (0..3, _) => Role::Spatial,
            (_, 1) => Role::Single,
            _ => {
                notes.push(format!("axis {axis} has no kind; it is taken as a list of volumes"));
                Role::Step
            }
        };
    }
    Ok(())
}

/// Arrays of four axes of space are a list of volumes: that is how many programs write time.
fn settle_beyond_three(roles: &mut [Role], sizes: &[u64], notes: &mut Vec<String>) {
    let spatial: Vec<usize> = (0..roles.len()).filter(|&axis| roles[axis] == Role::Spatial).collect();
    for &axis in spatial.iter().skip(3) {
        if sizes[axis] == 1 {
            roles[axis] = Role::Single;
        } else {
            notes.push(format!("axis {axis} is a fourth axis of space; it is taken as a list of volumes"));
            roles[axis] = Role::Step;
        }
    }
}
