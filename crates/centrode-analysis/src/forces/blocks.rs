/// Orders things into blocks. Each block can be computed once the blocks before it are known; the things in one block need
/// each other. `needs[i][j]` is whether `i` needs `j`.
///
/// Source: the transitive closure by Warshall's algorithm.
pub(super) fn blocks(mut needs: Vec<Vec<bool>>) -> Vec<Vec<usize>> {
    let count = needs.len();
    for (one, row) in needs.iter_mut().enumerate() {
        row[one] = true;
    }
    for via in 0..count {
        for from in 0..count {
            if needs[from][via] {
                let beyond = needs[via].clone();
                for (to, reached) in needs[from].iter_mut().zip(beyond) {
                    *to |= reached;
                }
            }
        }
    }
    let mut blocks: Vec<Vec<usize>> = Vec::new();
    for (one, needed) in needs.iter().enumerate() {
        let alike = |block: &&mut Vec<usize>| needed[block[0]] && needs[block[0]][one];
        match blocks.iter_mut().find(alike) {
            Some(block) => block.push(one),
            None => blocks.push(vec![one]),
        }
    }
    // Blocks that need more things come later.
    blocks.sort_by_key(|block| needs[block[0]].iter().filter(|need| **need).count());
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_needed_comes_first_and_a_ring_is_one_block() {
        let arrows = [[0, 3], [3, 1], [1, 4], [4, 1], [2, 2]];
        let mut needs = vec![vec![false; 5]; 5];
        for [from, to] in arrows {
            needs[from][to] = true;
        }
        let found = blocks(needs);
        let at = |one: usize| found.iter().position(|block| block.contains(&one));
        assert!(found.contains(&vec![1, 4]) && found.contains(&vec![2]));
        assert!(at(0) > at(3) && at(3) > at(1), "{found:?}");
        assert_eq!(found.iter().flatten().count(), 5);
    }
}
